// Reads a film as an image: resolve.comp makes floats of its sums on the device, and 12 bytes a pixel come over the bus.
// Owned by RenderDevice; bound to its film.
#pragma once

#include "lib/film/device_film.h"
#include "lib/film/film_header.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "shaders/gpu_layout.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace pt {

// What is read of the pixels of a film.
struct ImageQuery {
    Rectangle pixels;    // of the film, at least one
    bool standard_error; // of the mean, instead of the mean
    double unit;         // of the film, a power of two, in radiance
    PartCounts samples;  // that every pixel has
};

class ImageReader {
public:
    // All must outlive it. resolve: of resolve_pipeline().
    ImageReader(vulkan::Device &device, const vulkan::ComputePipeline &resolve, DeviceFilm &film) :
        device_(device),
        resolve_(resolve),
        film_(film) {}

    // Calls receive(values) for consecutive pieces of the pixels, row by row: R, G, B of each. Throws PT_ERROR_INTERNAL
    // if a driver lost work.
    void read(const ImageQuery &query, const std::function<void(std::span<const float>)> &receive);

private:
    // Where a piece is resolved, and then read by the host.
    struct Slot {
        vulkan::Buffer resolved;
        vulkan::Buffer findings;
        vulkan::Buffer host;                     // findings, then what has been resolved
        std::vector<vulkan::DescriptorSet> sets; // one per strip of the film
    };

    Slot &slot(std::size_t index, std::uint32_t pixel_count);
    vulkan::Device::Ticket start(Slot &slot, gpu::ResolveConstants constants);

    vulkan::Device &device_;
    const vulkan::ComputePipeline &resolve_;
    DeviceFilm &film_;
    std::vector<Slot> slots_;
};

vulkan::ComputePipeline resolve_pipeline(vulkan::Device &device, std::span<const std::uint32_t> code);

} // namespace pt
