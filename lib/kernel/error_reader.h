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

struct ErrorQuery {
    double unit; // radiance per film unit, a power of two
    const TileSamples &samples;
    std::span<double> by_tile{}; // receives own_square() of each tile (tile_errors.h)
};

class ErrorReader {
public:
    ErrorReader(vulkan::Device &device, const vulkan::ComputePipeline &estimate, DeviceFilm &film);

    using Receive = std::function<void(const TileErrors &)>;

    // Passes sums over some tiles of a row to receive(), in a fixed order.
    void read(const ErrorQuery &query, const Receive &receive);

    // read() in two steps, for films of one strip. record() appends to the commands of a submission. collect() may be
    // called after the submission has ended. Only one such submission may be running.
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
    vulkan::Buffer errors_;
    vulkan::Buffer tile_counts_;
    vulkan::Buffer tile_squares_;
    std::vector<vulkan::DescriptorSet> sets_;
};

vulkan::ComputePipeline estimate_pipeline(vulkan::Device &device, std::span<const std::uint32_t> code);

} // namespace pt
