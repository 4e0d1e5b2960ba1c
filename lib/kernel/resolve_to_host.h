// Reads a film as an image. resolve.comp computes the pixels, so that few bytes are transferred.
#pragma once

#include "lib/kernel/resolve.h"
#include "lib/kernel/resolved_pixels.h"
#include "lib/vulkan/submissions_under_way.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace pt {

class ResolveToHost {
public:
    ResolveToHost(vulkan::Device &device, ResolvePipelines &pipelines, DeviceFilm &film) :
        device_(device),
        pipelines_(pipelines),
        film_(film) {}

    // Passes consecutive pieces of the pixels, row by row, to receive(). Throws PT_ERROR_INTERNAL if a driver lost
    // work.
    void read(const ImageQuery &query, const std::function<void(std::span<const std::byte>)> &receive);

    // Returns all pixels without gaps. The memory is valid until the next call.
    std::span<std::byte> map(const ImageQuery &query);

private:
    struct Slot {
        ResolvedPixels results;
        std::vector<vulkan::DescriptorSet> sets;
    };

    struct Pieces {
        explicit Pieces(const ImageQuery &query);
        std::uint64_t count() const { return (total + most - 1) / most; }
        std::uint64_t pixels_of(std::uint64_t piece) const { return std::min(most, total - piece * most); }

        std::uint64_t total;
        std::uint64_t most;
        std::uint64_t bytes_of_pixel;
    };

    Slot &slot(std::size_t index, std::uint64_t bytes, std::uint32_t format);
    void record(const vk::raii::CommandBuffer &commands, const Slot &slot, const ImageQuery &query,
                const Pieces &pieces, std::uint64_t piece) const;

    vulkan::Device &device_;
    ResolvePipelines &pipelines_;
    DeviceFilm &film_;
    std::vector<Slot> slots_;
    std::optional<vulkan::Buffer> mapped_;
};

} // namespace pt
