#include "lib/kernel/film_sum.h"

#include "lib/base/stream_copy.h"

#include <algorithm>
#include <array>

namespace pt {

namespace {

// 3.5 MiB keep a bus busy and fit into the cache.
constexpr std::uint32_t most_piece_pixels = 1U << 15;

} // namespace

vulkan::ComputePipeline add_pipeline(vulkan::Device &device, std::span<const std::uint32_t> code) {
    constexpr vulkan::Binding bindings[] = {{gpu::BINDING_FILM}, {gpu::BINDING_ADDED}};
    return {device, code, bindings, sizeof(gpu::AddConstants), {}};
}

FilmSum::FilmSum(const std::vector<Source> &sources, const vulkan::ComputePipeline &add, std::uint32_t row_count) :
    home_(sources.front()),
    add_(add),
    film_(home_.device, home_.film.width(), row_count,
          max_strip_pixels(home_.device.limits(), home_.film.has_coverage()), home_.film.has_coverage()),
    piece_pixels_(std::min(film_.pixel_count(), most_piece_pixels)) {
    const auto bind = [&](const vulkan::Buffer &words) {
        std::vector<vulkan::DescriptorSet> sets;
        for (const DeviceFilm::Strip &strip : film_.strips())
            sets.push_back(add_.bind(std::array<vulkan::BufferRange, 2>{strip.words, words}));
        return sets;
    };
    for (const DeviceFilm::Strip &strip : home_.film.strips())
        own_sets_.push_back(bind(strip.words));
    for (const Source &source : std::span(sources).subspan(1)) {
        Distant &distant = others_.emplace_back(Distant{source, {}});
        for (std::uint32_t i = 0; i < source.device.policy().queue_depth; ++i)
            distant.slots.emplace_back(source.device, vulkan::BufferUse::HostRead,
                                       piece_pixels_ * film_.bytes_per_pixel(), "films on their way");
    }
    for (std::uint32_t i = 0; i < home_.device.policy().queue_depth && !others_.empty(); ++i) {
        slots_.emplace_back(home_.device, vulkan::BufferUse::HostWritten, piece_pixels_ * film_.bytes_per_pixel(),
                            "films on their way");
        slot_sets_.push_back(bind(slots_.back()));
    }
}

void FilmSum::gather(std::uint32_t first_row, const PixelRange &wanted) {
    const std::uint32_t first_pixel = first_row * film_.width();
    vulkan::SubmissionsUnderWay at_home(home_.device, home_.device.policy().queue_depth);
    at_home.start([&](const vk::raii::CommandBuffer &commands) {
        film_.clear(commands);
        vulkan::barrier_between_commands(commands);
        add_own(commands, first_pixel, wanted);
    });
    add_others(at_home, first_pixel, wanted);
    at_home.finish_all();
}

void FilmSum::add_own(const vk::raii::CommandBuffer &commands, std::uint32_t first_pixel,
                      const PixelRange &wanted) const {
    for (std::size_t i = 0; i < own_sets_.size(); ++i)
        add(commands, first_pixel, wanted, {home_.film.strips()[i].pixels(), own_sets_[i]});
}

// The host copies a piece while its device copies the next one and the first device adds the previous one.
void FilmSum::add_others(vulkan::SubmissionsUnderWay &at_home, std::uint32_t first_pixel, const PixelRange &wanted) {
    const auto piece = [&](std::uint32_t index) -> PixelRange {
        const std::uint32_t first = index * piece_pixels_;
        return {wanted.first + first, std::min(piece_pixels_, wanted.count - first)};
    };
    const std::uint32_t piece_count = (wanted.count + piece_pixels_ - 1) / piece_pixels_;
    struct Fetch {
        explicit Fetch(const Distant &of) : distant(of), under_way(of.source.device, of.slots.size()) {}

        const vulkan::Buffer &slot(std::uint32_t index) const { return distant.slots[index % distant.slots.size()]; }

        const Distant &distant;
        vulkan::SubmissionsUnderWay under_way;
    };
    const auto start = [&](Fetch &fetch, std::uint32_t index) {
        fetch.under_way.start([&](const vk::raii::CommandBuffer &commands) {
            fetch.distant.source.film.copy_to(commands, piece(index), fetch.slot(index));
        });
    };
    std::list<Fetch> fetches;
    for (const Distant &distant : others_) {
        Fetch &fetch = fetches.emplace_back(distant);
        for (std::uint32_t i = 0; i < std::min<std::size_t>(piece_count, distant.slots.size()); ++i)
            start(fetch, i);
    }
    std::size_t slot = 0;
    for (std::uint32_t index = 0; index < piece_count; ++index)
        for (Fetch &fetch : fetches) {
            const PixelRange pixels = piece(index);
            fetch.under_way.finish_first();
            if (at_home.count() == slots_.size())
                at_home.finish_first();
            stream_copy(fetch.slot(index).host_memory().first(pixels.count * film_.bytes_per_pixel()),
                        slots_[slot].host_memory().data());
            at_home.start([&](const vk::raii::CommandBuffer &commands) {
                add(commands, first_pixel, wanted, {pixels, slot_sets_[slot]});
            });
            slot = (slot + 1) % slots_.size();
            if (const auto next = static_cast<std::uint32_t>(index + fetch.distant.slots.size()); next < piece_count)
                start(fetch, next);
        }
}

void FilmSum::add(const vk::raii::CommandBuffer &commands, std::uint32_t first_pixel, const PixelRange &wanted,
                  const Added &added) const {
    gpu::AddConstants constants{};
    constants.added_stride = added.pixels.count;
    constants.has_coverage = film_.has_coverage() ? 1 : 0;
    for (std::size_t i = 0; i < added.sets.size(); ++i) {
        const DeviceFilm::Strip &strip = film_.strips()[i];
        const PixelRange of_strip{first_pixel + strip.first_pixel, strip.pixel_count};
        const auto [first, count] = common_pixels(common_pixels(of_strip, wanted), added.pixels);
        if (count == 0)
            continue;
        constants.strip_pixel_count = strip.pixel_count;
        constants.first_pixel = first - of_strip.first;
        constants.pixel_count = count;
        constants.added_first_pixel = first - added.pixels.first;
        const std::uint32_t groups = (constants.pixel_count + gpu::WORKGROUP_SIZE - 1) / gpu::WORKGROUP_SIZE;
        add_.dispatch(commands, added.sets[i], std::as_bytes(std::span(&constants, 1)), groups);
    }
}

} // namespace pt
