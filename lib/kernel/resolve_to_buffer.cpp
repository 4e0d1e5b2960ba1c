#include "lib/kernel/resolve_to_buffer.h"

#include <algorithm>
#include <array>

namespace pt {

namespace {

constexpr std::uint64_t word_bytes = sizeof(std::uint32_t);
constexpr std::uint64_t most_pixel_bytes = pixel_bytes(PT_FORMAT_RGBA32F);

} // namespace

ResolveToBuffer::PieceLimits ResolveToBuffer::piece_limits(const vulkan::Limits &limits) {
    const std::uint64_t bytes = limits.max_storage_buffer_range - limits.storage_buffer_alignment;
    const std::uint64_t dispatched = std::uint64_t{limits.max_workgroup_count} * gpu::WORKGROUP_SIZE;
    return {std::min({dispatched, bytes / most_pixel_bytes, std::uint64_t{UINT32_MAX}}), bytes};
}

ResolveToBuffer::ResolveToBuffer(vulkan::Device &device, ResolvePipelines &pipelines, DeviceFilm &film,
                                 const PieceLimits &limits) :
    device_(device),
    pipelines_(pipelines),
    film_(film),
    limits_(limits),
    results_(device, 0, "findings") {}

ResolveToBuffer::~ResolveToBuffer() {
    try {
        if (under_way_ && !device_.hangs())
            device_.finish(*under_way_);
    } catch (...) { // a destructor cannot report a lost device
    }
}

void ResolveToBuffer::write(const ImageQuery &query, const BufferTarget &target) {
    finish();
    const vulkan::ComputePipeline &pipeline = pipelines_.of(query.format);
    const std::vector<Piece> pieces = this->pieces(query, target);
    sets_.clear();
    for (const Piece &piece : pieces)
        for (const DeviceFilm::Strip &strip : film_.strips())
            sets_.push_back(
                pipeline.bind(std::array<vulkan::BufferRange, 3>{strip.words, piece.range, results_.findings()}));
    const auto record = [&](const vk::raii::CommandBuffer &commands) {
        results_.clear(commands);
        std::span<const vulkan::DescriptorSet> sets = sets_;
        for (const Piece &piece : pieces) {
            resolve(commands, pipeline, film_, sets.first(film_.strips().size()), query, piece.resolved);
            sets = sets.subspan(film_.strips().size());
        }
        results_.hand_over(commands, 0);
    };
    under_way_ = device_.start(record, target.semaphores);
    if (!target.semaphores.signal)
        finish();
}

std::vector<ResolveToBuffer::Piece> ResolveToBuffer::pieces(const ImageQuery &query, const BufferTarget &target) const {
    const Rectangle &all = query.pixels;
    const auto width = static_cast<std::uint32_t>(std::min<std::uint64_t>(all.width, limits_.pixels));
    const std::uint64_t rows_that_fit = std::min(limits_.pixels / width, limits_.bytes / target.row_bytes);
    const auto height = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(rows_that_fit, 1, all.height));
    std::vector<Piece> pieces;
    for (std::uint32_t y = 0; y < all.height; y += std::min(height, all.height - y))
        for (std::uint32_t x = 0; x < all.width; x += std::min(width, all.width - x))
            pieces.push_back(
                piece({all.x + x, all.y + y, std::min(width, all.width - x), std::min(height, all.height - y)}, query,
                      target));
    return pieces;
}

ResolveToBuffer::Piece ResolveToBuffer::piece(const Rectangle &pixels, const ImageQuery &query,
                                              const BufferTarget &target) const {
    const std::uint64_t bytes_of_pixel = pixel_bytes(query.format);
    const std::uint64_t begin =
        target.offset + (pixels.y - query.pixels.y) * target.row_bytes + (pixels.x - query.pixels.x) * bytes_of_pixel;
    const std::uint64_t end = begin + (pixels.height - 1) * target.row_bytes + pixels.width * bytes_of_pixel;
    const std::uint64_t bound =
        begin / device_.limits().storage_buffer_alignment * device_.limits().storage_buffer_alignment;
    const std::uint64_t row_words = pixels.height > 1 ? target.row_bytes / word_bytes : 0;
    return {{pixels, static_cast<std::uint32_t>((begin - bound) / word_bytes), static_cast<std::uint32_t>(row_words)},
            {target.buffer, bound, end - bound}};
}

void ResolveToBuffer::finish() {
    if (!under_way_)
        return;
    const vulkan::Device::Ticket ticket = *under_way_;
    under_way_.reset();
    device_.finish(ticket);
    require_no_loss(results_.lost_pixels());
}

} // namespace pt
