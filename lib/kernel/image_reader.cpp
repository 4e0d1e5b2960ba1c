#include "lib/kernel/image_reader.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace pt {

namespace {

// Large enough for a bus to be busy with one, small enough to wait little for the first: 3 MiB.
constexpr std::uint32_t read_pixels = 1U << 18;

} // namespace

// The device resolves a piece, and copies it, while the host takes the one before.
void ImageReader::read(const ImageQuery &query, const std::function<void(std::span<const std::byte>)> &receive) {
    const std::uint64_t bytes_of_pixel = pixel_bytes(query.format);
    const std::uint64_t total = query.pixels.pixel_count();
    const std::uint64_t rows_in_piece = std::max(read_pixels / query.pixels.width, 1U);
    const std::uint64_t most = std::min(rows_in_piece * query.pixels.width, total);
    const std::size_t slot_count = std::min<std::uint64_t>(device_.policy().queue_depth, (total + most - 1) / most);
    for (std::size_t i = 0; i < slot_count; ++i)
        slot(i, most * bytes_of_pixel, query.format);

    gpu::ResolveConstants constants = resolve_constants(query, film_);
    constants.row_words = static_cast<std::uint32_t>(query.pixels.width * bytes_of_pixel / sizeof(std::uint32_t));
    const auto pixels_of = [&](std::uint64_t piece) { return std::min(most, total - piece * most); };
    const std::uint64_t piece_count = (total + most - 1) / most;
    vulkan::SubmissionsUnderWay under_way(device_, slot_count);
    const auto start = [&](std::uint64_t piece) {
        const std::uint64_t row = query.pixels.y + piece * most / query.pixels.width;
        constants.first_pixel = static_cast<std::uint32_t>(row * film_.width() + query.pixels.x);
        constants.pixel_count = static_cast<std::uint32_t>(pixels_of(piece));
        under_way.start(
            [&](const auto &commands) { record(commands, slots_[piece % slot_count], query.format, constants); });
    };
    for (std::uint64_t piece = 0; piece < slot_count; ++piece)
        start(piece);
    for (std::uint64_t piece = 0; piece < piece_count; ++piece) {
        under_way.finish_first();
        const std::span<const std::byte> bytes = slots_[piece % slot_count].host.host_bytes();
        std::uint32_t lost_pixels = 0;
        std::memcpy(&lost_pixels, bytes.data(), sizeof lost_pixels);
        require_no_loss(lost_pixels);
        receive(bytes.subspan(findings_bytes, pixels_of(piece) * bytes_of_pixel));
        if (piece + slot_count < piece_count)
            start(piece + slot_count);
    }
}

ImageReader::Slot &ImageReader::slot(std::size_t index, std::uint64_t bytes, std::uint32_t format) {
    const bool fits = index < slots_.size() && slots_[index].resolved.size() >= bytes;
    if (fits)
        return slots_[index];
    using enum vulkan::BufferUse;
    Slot made{{device_, Storage, bytes, "image"},
              {device_, Storage, findings_bytes, "findings"},
              {device_, HostRead, findings_bytes + bytes, "image"},
              {}};
    for (DeviceFilm::Strip &strip : film_.strips()) {
        const std::array<vulkan::Buffer *, 5> buffers = {nullptr, nullptr, &strip.words, &made.resolved,
                                                         &made.findings};
        made.sets.push_back(pipelines_.of(format).bind(buffers));
    }
    if (index < slots_.size())
        slots_[index] = std::move(made);
    else
        slots_.push_back(std::move(made));
    return slots_[index];
}

void ImageReader::record(const vk::raii::CommandBuffer &commands, const Slot &slot, std::uint32_t format,
                         const gpu::ResolveConstants &constants) const {
    slot.findings.clear(commands, 0, findings_bytes);
    vulkan::barrier_between_commands(commands);
    resolve(commands, pipelines_.of(format), film_, slot.sets, constants);
    vulkan::barrier_between_commands(commands);
    slot.host.copy(commands, slot.findings, findings_bytes);
    slot.host.copy(commands, slot.resolved, std::uint64_t{constants.pixel_count} * pixel_bytes(format), findings_bytes);
}

} // namespace pt
