#include "lib/kernel/resolve_to_host.h"

#include <array>
#include <cstring>

namespace pt {

namespace {

constexpr std::uint32_t read_pixels = 1U << 18;

} // namespace

ResolveToHost::Pieces::Pieces(const ImageQuery &query) :
    total(query.pixels.pixel_count()),
    most(std::min<std::uint64_t>(std::uint64_t{std::max(read_pixels / query.pixels.width, 1U)} * query.pixels.width,
                                 total)),
    bytes_of_pixel(pixel_bytes(query.format)) {}

// The host reads a piece while the device computes the next one.
void ResolveToHost::read(const ImageQuery &query, const std::function<void(std::span<const std::byte>)> &receive) {
    const Pieces pieces(query);
    const std::size_t slot_count = std::min<std::uint64_t>(device_.policy().queue_depth, pieces.count());
    for (std::size_t i = 0; i < slot_count; ++i)
        slot(i, pieces.most * pieces.bytes_of_pixel, query.format);

    vulkan::SubmissionsUnderWay under_way(device_, slot_count);
    const auto start = [&](std::uint64_t piece) {
        under_way.start([&](const vk::raii::CommandBuffer &commands) {
            const Slot &slot = slots_[piece % slot_count];
            slot.results.clear(commands);
            record(commands, slot, query, pieces, piece);
            slot.results.hand_over(commands, pieces.pixels_of(piece) * pieces.bytes_of_pixel);
        });
    };
    for (std::uint64_t piece = 0; piece < slot_count; ++piece)
        start(piece);
    for (std::uint64_t piece = 0; piece < pieces.count(); ++piece) {
        under_way.finish_first();
        const ResolvedPixels &results = slots_[piece % slot_count].results;
        require_no_loss(results.lost_pixels());
        receive(results.bytes().first(pieces.pixels_of(piece) * pieces.bytes_of_pixel));
        if (piece + slot_count < pieces.count())
            start(piece + slot_count);
    }
}

std::span<std::byte> ResolveToHost::map(const ImageQuery &query) {
    const Pieces pieces(query);
    const std::uint64_t image_bytes = pieces.total * pieces.bytes_of_pixel;
    const Slot &slot = this->slot(0, pieces.most * pieces.bytes_of_pixel, query.format);
    std::uint32_t lost_pixels = 0;
    if (!mapped_ || mapped_->size() < image_bytes + sizeof lost_pixels) {
        mapped_.reset();
        mapped_.emplace(device_, vulkan::BufferUse::HostRead, image_bytes + sizeof lost_pixels, "mapped image");
    }
    device_.submit([&](const vk::raii::CommandBuffer &commands) {
        slot.results.clear(commands);
        for (std::uint64_t piece = 0; piece < pieces.count(); ++piece) {
            record(commands, slot, query, pieces, piece);
            mapped_->copy(commands, slot.results.found(),
                          vk::BufferCopy{.srcOffset = ResolvedPixels::findings_bytes,
                                         .dstOffset = piece * pieces.most * pieces.bytes_of_pixel,
                                         .size = pieces.pixels_of(piece) * pieces.bytes_of_pixel});
        }
        mapped_->copy(commands, slot.results.found(),
                      vk::BufferCopy{.dstOffset = image_bytes, .size = sizeof lost_pixels});
    });
    const std::span<std::byte> memory = mapped_->host_memory();
    std::memcpy(&lost_pixels, memory.subspan(image_bytes).data(), sizeof lost_pixels);
    require_no_loss(lost_pixels);
    return memory.first(image_bytes);
}

ResolveToHost::Slot &ResolveToHost::slot(std::size_t index, std::uint64_t bytes, std::uint32_t format) {
    if (index < slots_.size() && slots_[index].results.room() >= bytes)
        return slots_[index];
    Slot made{{device_, bytes, "image"}, {}};
    for (const DeviceFilm::Strip &strip : film_.strips())
        made.sets.push_back(pipelines_.of(format).bind(
            std::array<vulkan::BufferRange, 3>{strip.words, made.results.pixels(), made.results.findings()}));
    if (index == slots_.size())
        slots_.push_back(std::move(made));
    else
        slots_[index] = std::move(made);
    return slots_[index];
}

void ResolveToHost::record(const vk::raii::CommandBuffer &commands, const Slot &slot, const ImageQuery &query,
                           const Pieces &pieces, std::uint64_t piece) const {
    const auto [x, y, width, height] = query.pixels;
    const auto first_row = static_cast<std::uint32_t>(piece * pieces.most / width);
    const auto rows = static_cast<std::uint32_t>(pieces.pixels_of(piece) / width);
    const auto row_words = static_cast<std::uint32_t>(width * pieces.bytes_of_pixel / sizeof(std::uint32_t));
    resolve(commands, pipelines_.of(query.format), film_, slot.sets, query,
            {{x, y + first_row, width, rows}, 0, row_words});
}

} // namespace pt
