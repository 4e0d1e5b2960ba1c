#include "lib/kernel/image_reader.h"

#include "lib/base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

namespace pt {

namespace {

// Large enough for a bus to be busy with one, small enough to wait little for the first: 3 MiB.
constexpr std::uint32_t read_pixels = 1U << 18;

constexpr std::uint64_t findings_bytes = sizeof(std::uint32_t);

std::uint64_t bytes_of(std::uint32_t pixel_count) {
    return std::uint64_t{pixel_count} * 3 * sizeof(float);
}

gpu::ResolveConstants constants_of(const ImageQuery &query, const DeviceFilm &film) {
    gpu::ResolveConstants constants{};
    constants.sample_counts = {static_cast<std::uint32_t>(query.samples[older_part]),
                               static_cast<std::uint32_t>(query.samples[newer_part])};
    constants.older_part = film.parts().older();
    constants.exponent = std::ilogb(query.unit) - static_cast<int>(gpu::FILM_FRACTION_BITS);
    constants.standard_error = query.standard_error ? 1 : 0;
    constants.film_width = film.width();
    constants.width = query.pixels.width;
    return constants;
}

} // namespace

vulkan::ComputePipeline resolve_pipeline(vulkan::Device &device, std::span<const std::uint32_t> code) {
    constexpr std::array bindings = {vulkan::no_binding, vulkan::no_binding, vk::DescriptorType::eStorageBuffer,
                                     vk::DescriptorType::eStorageBuffer, vk::DescriptorType::eStorageBuffer};
    static_assert(gpu::BINDING_FILM == 2 && gpu::BINDING_RESOLVED == 3 && gpu::BINDING_FINDINGS == 4);
    return {device, code, bindings, sizeof(gpu::ResolveConstants), {}};
}

// The device resolves a piece, and copies it, while the host takes the one before.
void ImageReader::read(const ImageQuery &query, const std::function<void(std::span<const float>)> &receive) {
    const std::uint64_t total = query.pixels.pixel_count();
    const std::uint64_t rows_in_piece = std::max(read_pixels / query.pixels.width, 1U);
    const std::uint64_t most = std::min(rows_in_piece * query.pixels.width, total);
    const std::size_t slot_count = std::min<std::uint64_t>(device_.policy().queue_depth, (total + most - 1) / most);
    for (std::size_t i = 0; i < slot_count; ++i)
        slot(i, static_cast<std::uint32_t>(most));

    struct Piece {
        std::size_t slot;
        vulkan::Device::Ticket ticket;
        std::uint32_t pixel_count;
    };
    gpu::ResolveConstants constants = constants_of(query, film_);
    std::vector<Piece> under_way;
    under_way.reserve(slot_count);
    std::uint64_t started = 0;
    for (std::size_t next_slot = 0; started < total || !under_way.empty();) {
        if (started < total && under_way.size() < slot_count) {
            const std::uint64_t row = query.pixels.y + started / query.pixels.width;
            constants.first_pixel = static_cast<std::uint32_t>(row * film_.width() + query.pixels.x);
            constants.pixel_count = static_cast<std::uint32_t>(std::min(most, total - started));
            under_way.push_back({next_slot, start(slots_[next_slot], constants), constants.pixel_count});
            started += constants.pixel_count;
            next_slot = (next_slot + 1) % slot_count;
            continue;
        }
        const Piece piece = under_way.front();
        under_way.erase(under_way.begin());
        device_.finish(piece.ticket);
        const std::span<const std::byte> bytes = slots_[piece.slot].host.host_bytes();
        std::uint32_t lost_pixels = 0;
        std::memcpy(&lost_pixels, bytes.data(), sizeof lost_pixels);
        if (lost_pixels > 0)
            throw Error(PT_ERROR_INTERNAL, "the driver lost samples of " + std::to_string(lost_pixels) + " pixels");
        const auto *const values = reinterpret_cast<const float *>(bytes.data() + findings_bytes);
        receive({values, std::size_t{3} * piece.pixel_count});
    }
}

ImageReader::Slot &ImageReader::slot(std::size_t index, std::uint32_t pixel_count) {
    const bool fits = index < slots_.size() && slots_[index].resolved.size() >= bytes_of(pixel_count);
    if (fits)
        return slots_[index];
    using enum vulkan::BufferUse;
    Slot made{{device_, Storage, bytes_of(pixel_count), "image"},
              {device_, Storage, findings_bytes, "findings"},
              {device_, HostRead, findings_bytes + bytes_of(pixel_count), "image"},
              {}};
    for (DeviceFilm::Strip &strip : film_.strips()) {
        const std::array<vulkan::Buffer *, 5> buffers = {nullptr, nullptr, &strip.words, &made.resolved,
                                                         &made.findings};
        made.sets.push_back(resolve_.bind(buffers));
    }
    if (index < slots_.size())
        slots_[index] = std::move(made);
    else
        slots_.push_back(std::move(made));
    return slots_[index];
}

vulkan::Device::Ticket ImageReader::start(Slot &slot, gpu::ResolveConstants constants) {
    return device_.start([&](const vk::raii::CommandBuffer &commands) {
        slot.findings.clear(commands, 0, findings_bytes);
        vulkan::barrier_between_commands(commands);
        for (std::size_t i = 0; i < slot.sets.size(); ++i) {
            const DeviceFilm::Strip &strip = film_.strips()[i];
            constants.strip_first_pixel = strip.first_pixel;
            constants.strip_pixel_count = strip.pixel_count;
            const std::uint32_t groups = (constants.pixel_count + gpu::WORKGROUP_SIZE - 1) / gpu::WORKGROUP_SIZE;
            resolve_.dispatch(commands, slot.sets[i], std::as_bytes(std::span(&constants, 1)), groups);
        }
        vulkan::barrier_between_commands(commands);
        slot.host.copy(commands, slot.findings, findings_bytes);
        slot.host.copy(commands, slot.resolved, bytes_of(constants.pixel_count), findings_bytes);
    });
}

} // namespace pt
