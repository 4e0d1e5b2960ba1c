// Resolves a film into a buffer that the caller owns. Everything happens on the device; no pixel passes through the
// host. Owned by RenderDevice; bound to its film.
#pragma once

#include "lib/kernel/pixel_results.h"
#include "lib/kernel/resolve.h"
#include "lib/vulkan/buffer.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pt {

// Where the pixels go. Offset and distance of rows are multiples of 4.
struct BufferTarget {
    vk::Buffer buffer;
    std::uint64_t offset;    // of the first pixel, in bytes
    std::uint64_t row_bytes; // distance between rows
    vulkan::Semaphores semaphores;
};

class BufferWriter {
public:
    // The largest part of an image that one dispatch resolves.
    struct PieceLimits {
        std::uint64_t pixels; // at least one, and whatever their format, they fit the bytes
        std::uint64_t bytes;  // of the buffer, gaps between rows included
    };
    static PieceLimits piece_limits(const vulkan::Limits &limits);

    // The arguments must outlive the writer.
    BufferWriter(vulkan::Device &device, ResolvePipelines &pipelines, DeviceFilm &film, const PieceLimits &limits);
    // Waits for the device to finish.
    ~BufferWriter();
    BufferWriter(const BufferWriter &) = delete;
    BufferWriter &operator=(const BufferWriter &) = delete;

    // Returns when the device has written the pixels. With a semaphore to signal, it returns as soon as the work is
    // submitted; the next call waits for that work first. Throws PT_ERROR_INTERNAL if a driver lost work; if the lost
    // work was that of an earlier call, nothing has been written.
    void write(const ImageQuery &query, const BufferTarget &target);

private:
    // A piece of the image, and the binding that it has a place in.
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
    PixelResults results_;                    // of pixels only how many were lost
    std::vector<vulkan::DescriptorSet> sets_; // of the work under way: those of each strip, piece by piece
    std::optional<vulkan::Device::Ticket> under_way_;
};

} // namespace pt
