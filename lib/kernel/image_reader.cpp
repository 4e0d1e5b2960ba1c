#include "lib/kernel/image_reader.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace pt {

namespace {

// Large enough for a bus to be busy with one, small enough to wait little for the first: 3 MiB.
constexpr std::uint32_t read_pixels = 1U << 18;

struct Piece {
    std::size_t slot;
    vulkan::Device::Ticket ticket;
    std::uint32_t pixel_count;
};

// Submissions in the order of their starts. Whatever fails, all are waited for at the end.
class PiecesUnderWay {
public:
    PiecesUnderWay(vulkan::Device &device, std::size_t most) : device_(device) { pieces_.reserve(most); }
    PiecesUnderWay(const PiecesUnderWay &) = delete;
    PiecesUnderWay &operator=(const PiecesUnderWay &) = delete;
    ~PiecesUnderWay() {
        try {
            while (!pieces_.empty())
                finish_first();
        } catch (...) { // the device is lost, and whoever failed tells of it
        }
    }

    std::size_t count() const { return pieces_.size(); }
    void add(const Piece &piece) { pieces_.push_back(piece); }

    Piece finish_first() {
        const Piece piece = pieces_.front();
        pieces_.erase(pieces_.begin());
        device_.finish(piece.ticket);
        return piece;
    }

private:
    vulkan::Device &device_;
    std::vector<Piece> pieces_;
};

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
    PiecesUnderWay under_way(device_, slot_count);
    std::uint64_t started = 0;
    for (std::size_t next_slot = 0; started < total || under_way.count() > 0;) {
        if (started < total && under_way.count() < slot_count) {
            const std::uint64_t row = query.pixels.y + started / query.pixels.width;
            constants.first_pixel = static_cast<std::uint32_t>(row * film_.width() + query.pixels.x);
            constants.pixel_count = static_cast<std::uint32_t>(std::min(most, total - started));
            under_way.add({next_slot, start(slots_[next_slot], query.format, constants), constants.pixel_count});
            started += constants.pixel_count;
            next_slot = (next_slot + 1) % slot_count;
            continue;
        }
        const Piece piece = under_way.finish_first();
        const std::span<const std::byte> bytes = slots_[piece.slot].host.host_bytes();
        std::uint32_t lost_pixels = 0;
        std::memcpy(&lost_pixels, bytes.data(), sizeof lost_pixels);
        require_no_loss(lost_pixels);
        receive(bytes.subspan(findings_bytes, piece.pixel_count * bytes_of_pixel));
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

vulkan::Device::Ticket ImageReader::start(Slot &slot, std::uint32_t format, const gpu::ResolveConstants &constants) {
    const vulkan::ComputePipeline &pipeline = pipelines_.of(format);
    return device_.start([&](const vk::raii::CommandBuffer &commands) {
        slot.findings.clear(commands, 0, findings_bytes);
        vulkan::barrier_between_commands(commands);
        resolve(commands, pipeline, film_, slot.sets, constants);
        vulkan::barrier_between_commands(commands);
        slot.host.copy(commands, slot.findings, findings_bytes);
        slot.host.copy(commands, slot.resolved, std::uint64_t{constants.pixel_count} * pixel_bytes(format),
                       findings_bytes);
    });
}

} // namespace pt
