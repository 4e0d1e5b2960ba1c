#pragma once

#include "lib/kernel/resolve.h"
#include "lib/kernel/resolved_pixels.h"
#include "lib/vulkan/buffer.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pt {

// Offset and row_bytes must be multiples of 4.
struct BufferTarget {
    vk::Buffer buffer;
    std::uint64_t offset;
    std::uint64_t row_bytes;
    vulkan::Semaphores semaphores;
};

class ResolveToBuffer {
public:
    struct PieceLimits {
        std::uint64_t pixels;
        std::uint64_t bytes; // bytes with gaps between rows
    };
    static PieceLimits piece_limits(const vulkan::Limits &limits);

    ResolveToBuffer(vulkan::Device &device, ResolvePipelines &pipelines, DeviceFilm &film, const PieceLimits &limits);
    ~ResolveToBuffer();
    ResolveToBuffer(const ResolveToBuffer &) = delete;
    ResolveToBuffer &operator=(const ResolveToBuffer &) = delete;

    // Waits for the device or, if there is a semaphore to signal, leaves the wait to the next call. Throws
    // PT_ERROR_INTERNAL if a driver lost work. If the previous call lost work, nothing is written.
    void write(const ImageQuery &query, const BufferTarget &target);

private:
    struct Piece {
        ResolvedPiece resolved;
        vulkan::BufferRange range;
    };

    std::vector<Piece> pieces(const ImageQuery &query, const BufferTarget &target) const;
    Piece piece(const Rectangle &pixels, const ImageQuery &query, const BufferTarget &target) const;
    void finish();

    vulkan::Device &device_;
    ResolvePipelines &pipelines_;
    DeviceFilm &film_;
    PieceLimits limits_;
    ResolvedPixels results_;
    std::vector<vulkan::DescriptorSet> sets_;
    std::optional<vulkan::Device::Ticket> under_way_;
};

} // namespace pt
