#include "lib/kernel/host_fold.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace pt {

namespace {

// In an empty part these planes must be 0. The order is the same as in rare_plane() of film.glsl.
constexpr std::array<std::size_t, 4> rare_planes = {gpu::FILM_SUM_WORDS - 1, 2 * gpu::FILM_SUM_WORDS - 1,
                                                    3 * gpu::FILM_SUM_WORDS - 1, gpu::FILM_REJECTED};

template <typename Function>
void for_each_strip(DeviceFilm &film, const PixelRange &pixels, std::uint32_t part, const Function &function) {
    for (DeviceFilm::Strip &strip : film.strips()) {
        const auto [first, count] = common_pixels(pixels, strip.pixels());
        if (count == 0)
            continue;
        auto *const words = reinterpret_cast<std::uint32_t *>(strip.words.host_memory().data());
        const std::size_t first_of_part = std::size_t{part} * gpu::FILM_WORDS * strip.pixel_count;
        function(PartWords<std::uint32_t>{words + first_of_part + (first - strip.first_pixel), strip.pixel_count},
                 count);
    }
}

} // namespace

HostFold::~HostFold() {
    for (const PixelRange &pixels : folded_)
        combine(pixels, subtract_words);
}

bool HostFold::fold(std::vector<PixelRange> pixels) {
    if (std::ranges::any_of(pixels, [&](const PixelRange &range) { return has_rare_words(range); }))
        return false;
    folded_ = std::move(pixels);
    for (const PixelRange &range : folded_)
        combine(range, add_words);
    return true;
}

bool HostFold::has_rare_words(const PixelRange &pixels) const {
    std::uint32_t all = 0;
    for_each_strip(film_, pixels, 1 - into_, [&](const PartWords<std::uint32_t> &words, std::uint32_t count) {
        for (const std::size_t plane : rare_planes)
            for (const std::uint32_t word : std::span(words.first + plane * words.stride, count))
                all |= word;
    });
    return all != 0;
}

void HostFold::combine(const PixelRange &pixels, Operation operation) noexcept {
    for_each_strip(film_, pixels, into_, [&](const PartWords<std::uint32_t> &words, std::uint32_t count) {
        const std::ptrdiff_t words_of_part = static_cast<std::ptrdiff_t>(gpu::FILM_WORDS * words.stride);
        const std::uint32_t *const others = words.first + (into_ == 0 ? words_of_part : -words_of_part);
        operation(words, {others, words.stride}, count);
    });
}

} // namespace pt
