// Resolves a film into a buffer of the caller, all on the device. Owned by RenderDevice; bound to its film.
#pragma once

#include "lib/kernel/pixel_results.h"
#include "lib/kernel/resolve.h"
#include "lib/vulkan/buffer.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pt {

// Offset and row distance are multiples of 4.
struct BufferTarget {
    vk::Buffer buffer;
    std::uint64_t offset;    // of the first pixel, in bytes
    std::uint64_t row_bytes; // distance between rows
    vulkan::Semaphores semaphores;
};

class BufferWriter {
public:
    // The largest piece of an image per dispatch.
    struct PieceLimits {
        std::uint64_t pixels; // at least one; they fit the bytes in any format
        std::uint64_t bytes;  // of the buffer, gaps between rows included
    };
    static PieceLimits piece_limits(const vulkan::Limits &limits);

    // The arguments must outlive the writer.
    BufferWriter(vulkan::Device &device, ResolvePipelines &pipelines, DeviceFilm &film, const PieceLimits &limits);
    // Waits for the device to finish.
    ~BufferWriter();
    BufferWriter(const BufferWriter &) = delete;
    BufferWriter &operator=(const BufferWriter &) = delete;

    // Returns when the device has written the pixels; with a semaphore to signal, once the work is submitted, and the
    // next call waits for it first. Throws PT_ERROR_INTERNAL if a driver lost work; if an earlier call's work was lost,
    // nothing has been written.
    void write(const ImageQuery &query, const BufferTarget &target);

private:
    // A piece of the image and its binding.
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
    PixelResults results_;                    // counts lost pixels only
    std::vector<vulkan::DescriptorSet> sets_; // of the work under way, per strip and piece
    std::optional<vulkan::Device::Ticket> under_way_;
};

} // namespace pt
