// Reads a film as an image: resolve.comp makes pixels of its sums on the device, and 8 to 16 bytes of each come over
// the bus. Owned by RenderDevice; bound to its film.
#pragma once

#include "lib/kernel/resolve.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/submissions_under_way.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace pt {

class ImageReader {
public:
    // All must outlive it.
    ImageReader(vulkan::Device &device, ResolvePipelines &pipelines, DeviceFilm &film) :
        device_(device),
        pipelines_(pipelines),
        film_(film) {}

    // Calls receive(bytes) for consecutive pieces of the pixels, row by row. Throws PT_ERROR_INTERNAL if a driver lost
    // work.
    void read(const ImageQuery &query, const std::function<void(std::span<const std::byte>)> &receive);

private:
    // Where a piece is resolved, and then read by the host.
    struct Slot {
        vulkan::Buffer resolved;
        vulkan::Buffer findings;
        vulkan::Buffer host;                     // findings, then what has been resolved
        std::vector<vulkan::DescriptorSet> sets; // one per strip of the film
    };

    Slot &slot(std::size_t index, std::uint64_t bytes, std::uint32_t format);
    void record(const vk::raii::CommandBuffer &commands, const Slot &slot, std::uint32_t format,
                const gpu::ResolveConstants &constants) const;

    vulkan::Device &device_;
    ResolvePipelines &pipelines_;
    DeviceFilm &film_;
    std::vector<Slot> slots_;
};

} // namespace pt
