// Reads what a film says about the error of its image: estimate.comp sums it up over tiles, on the device. Owned by
// RenderDevice; bound to its film.
#pragma once

#include "lib/film/error_estimate.h"
#include "lib/kernel/device_film.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace pt {

// Which samples the error is asked for.
struct ErrorQuery {
    double unit;                 // of the film, a power of two, in radiance
    const TileSamples &samples;  // that the film has
    std::span<double> by_tile{}; // receives the own_square() of each tile (tile_errors.h), if it is not empty
};

class ErrorReader {
public:
    // All arguments must outlive the reader. estimate: from estimate_pipeline(). The strips of the film must be whole
    // rows of tiles.
    ErrorReader(vulkan::Device &device, const vulkan::ComputePipeline &estimate, DeviceFilm &film);

    using Receive = std::function<void(const TileErrors &)>;

    // Calls receive(tiles) for sums over a few tiles of a row each, always in the same order. Throws PT_ERROR_INTERNAL
    // if a driver lost work.
    void read(const ErrorQuery &query, const Receive &receive);

    // The same in two steps, for a film of one strip. record() adds the look behind commands that take samples; no
    // other such commands may be under way. collect() reads the result once they have ended.
    void record(const vk::raii::CommandBuffer &commands, const ErrorQuery &query);
    void collect(const ErrorQuery &query, const Receive &receive) const;

private:
    void record_strip(const vk::raii::CommandBuffer &commands, std::size_t strip, const ErrorQuery &query) const;
    TileGrid grid_of(std::size_t strip) const;
    void list_counts(const TileSamples &samples);
    void collect_tiles(const ErrorQuery &query) const;
    void collect_strip(std::size_t strip, const ErrorQuery &query, const Receive &receive) const;

    vulkan::Device &device_;
    const vulkan::ComputePipeline &estimate_;
    DeviceFilm &film_;
    vulkan::Buffer errors_;                   // of a strip, by workgroup
    vulkan::Buffer tile_counts_;              // by tiles of the film
    vulkan::Buffer tile_squares_;             // likewise
    std::vector<vulkan::DescriptorSet> sets_; // one per strip
};

vulkan::ComputePipeline estimate_pipeline(vulkan::Device &device, std::span<const std::uint32_t> code);

} // namespace pt
