#include "lib/kernel/image_reader.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace pt {

namespace {

// Large enough to keep a bus busy, and small enough that the first piece arrives soon: 3 MiB.
constexpr std::uint32_t read_pixels = 1U << 18;

void require_no_loss(std::span<const std::byte> findings) {
    std::uint32_t lost_pixels = 0;
    std::memcpy(&lost_pixels, findings.data(), sizeof lost_pixels);
    pt::require_no_loss(lost_pixels);
}

} // namespace

ImageReader::Pieces::Pieces(const ImageQuery &query) :
    total(query.pixels.pixel_count()),
    most(std::min<std::uint64_t>(std::uint64_t{std::max(read_pixels / query.pixels.width, 1U)} * query.pixels.width,
                                 total)),
    bytes_of_pixel(pixel_bytes(query.format)) {}

gpu::ResolveConstants ImageReader::constants_of(const ImageQuery &query, const Pieces &pieces,
                                                std::uint64_t piece) const {
    gpu::ResolveConstants constants = resolve_constants(query, film_);
    const std::uint64_t row = query.pixels.y + piece * pieces.most / query.pixels.width;
    constants.row_words =
        static_cast<std::uint32_t>(query.pixels.width * pieces.bytes_of_pixel / sizeof(std::uint32_t));
    constants.first_pixel = static_cast<std::uint32_t>(row * film_.width() + query.pixels.x);
    constants.pixel_count = static_cast<std::uint32_t>(pieces.pixels_of(piece));
    return constants;
}

// While the host takes a piece, the device resolves and copies the next.
void ImageReader::read(const ImageQuery &query, const std::function<void(std::span<const std::byte>)> &receive) {
    const Pieces pieces(query);
    const std::size_t slot_count = std::min<std::uint64_t>(device_.policy().queue_depth, pieces.count());
    for (std::size_t i = 0; i < slot_count; ++i)
        slot(i, pieces.most * pieces.bytes_of_pixel, query.format);

    vulkan::SubmissionsUnderWay under_way(device_, slot_count);
    const auto start = [&](std::uint64_t piece) {
        const Slot &slot = slots_[piece % slot_count];
        under_way.start([&](const vk::raii::CommandBuffer &commands) {
            slot.findings.clear(commands, 0, findings_bytes);
            record(commands, slot, query.format, constants_of(query, pieces, piece), slot.host, findings_bytes);
            slot.host.copy(commands, slot.findings, findings_bytes);
        });
    };
    for (std::uint64_t piece = 0; piece < slot_count; ++piece)
        start(piece);
    for (std::uint64_t piece = 0; piece < pieces.count(); ++piece) {
        under_way.finish_first();
        const std::span<const std::byte> bytes = slots_[piece % slot_count].host.host_bytes();
        require_no_loss(bytes);
        receive(bytes.subspan(findings_bytes, pieces.pixels_of(piece) * pieces.bytes_of_pixel));
        if (piece + slot_count < pieces.count())
            start(piece + slot_count);
    }
}

// In a single submission, since the host has nothing else to do.
std::span<std::byte> ImageReader::map(const ImageQuery &query) {
    const Pieces pieces(query);
    const std::uint64_t image_bytes = pieces.total * pieces.bytes_of_pixel;
    const Slot &slot = this->slot(0, pieces.most * pieces.bytes_of_pixel, query.format);
    if (!mapped_ || mapped_->size() < image_bytes + findings_bytes) {
        mapped_.reset(); // before the new one takes memory
        mapped_.emplace(device_, vulkan::BufferUse::HostRead, image_bytes + findings_bytes, "mapped image");
    }
    device_.submit([&](const vk::raii::CommandBuffer &commands) {
        slot.findings.clear(commands, 0, findings_bytes);
        for (std::uint64_t piece = 0; piece < pieces.count(); ++piece)
            record(commands, slot, query.format, constants_of(query, pieces, piece), *mapped_,
                   piece * pieces.most * pieces.bytes_of_pixel);
        mapped_->copy(commands, slot.findings, findings_bytes, image_bytes);
    });
    const std::span<std::byte> memory = mapped_->host_memory();
    require_no_loss(memory.subspan(image_bytes));
    return memory.first(image_bytes);
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

// After a barrier, because the previous piece may still be in transit.
void ImageReader::record(const vk::raii::CommandBuffer &commands, const Slot &slot, std::uint32_t format,
                         const gpu::ResolveConstants &constants, const vulkan::Buffer &to, std::uint64_t offset) const {
    vulkan::barrier_between_commands(commands);
    resolve(commands, pipelines_.of(format), film_, slot.sets, constants);
    vulkan::barrier_between_commands(commands);
    to.copy(commands, slot.resolved, std::uint64_t{constants.pixel_count} * pixel_bytes(format), offset);
}

} // namespace pt
