// Layout and read-out of the film; see film.h.
#include "film.h"

#include "error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

namespace pt {

double sum_of_words(const std::uint32_t words[gpu::FILM_SUM_WORDS]) {
    // unsigned __int128 to double rounds once, to nearest.
    __extension__ using Wide = unsigned __int128;
    const Wide low = words[0] | Wide{words[1]} << 32;
    const Wide high = words[2] | Wide{words[3]} << 32;
    return std::ldexp(static_cast<double>(low | high << 64), -static_cast<int>(gpu::FILM_FRACTION_BITS));
}

void mean_radiance(std::span<const std::uint32_t> words, std::size_t plane_pixels, double unit,
                   std::uint32_t expected_samples, std::span<float> radiance) {
    for (std::size_t pixel = 0; pixel < radiance.size() / 3; ++pixel) {
        const auto word = [&](std::size_t plane) { return words[plane * plane_pixels + pixel]; };
        const std::uint32_t accepted = word(gpu::FILM_ACCEPTED);
        const std::uint32_t done = accepted + word(gpu::FILM_REJECTED);
        if (done != expected_samples)
            throw Error(PT_ERROR_INTERNAL, "the driver did " + std::to_string(done) + " of " +
                                               std::to_string(expected_samples) + " samples of a pixel");
        for (std::size_t channel = 0; channel < 3; ++channel) {
            std::array<std::uint32_t, gpu::FILM_SUM_WORDS> sum{};
            for (std::size_t i = 0; i < sum.size(); ++i)
                sum[i] = word(channel * gpu::FILM_SUM_WORDS + i);
            const double mean = accepted > 0 ? sum_of_words(sum.data()) / accepted : 0.0;
            radiance[3 * pixel + channel] = static_cast<float>(mean * unit);
        }
    }
}

std::uint32_t max_strip_pixels(const vulkan::Limits &limits) {
    const std::uint64_t bytes = std::min<std::uint64_t>(limits.max_storage_buffer_range, limits.max_allocation_bytes);
    const std::uint64_t pixels = bytes / (gpu::FILM_WORDS * sizeof(std::uint32_t));
    const std::uint64_t dispatched = std::uint64_t{limits.max_workgroup_count} * gpu::WORKGROUP_SIZE;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>({pixels, dispatched, UINT32_MAX}));
}

Film::Film(vulkan::Device &device, std::uint32_t width, std::uint32_t height, std::uint32_t max_strip_pixels) :
    width_(width),
    height_(height) {
    for (std::uint32_t first = 0; first < pixel_count();) {
        const std::uint32_t count = std::min(max_strip_pixels, pixel_count() - first);
        const std::uint64_t words_bytes = std::uint64_t{count} * gpu::FILM_WORDS * sizeof(std::uint32_t);
        const std::uint64_t pass_bytes = std::uint64_t{count} * sizeof(glm::vec4);
        strips_.push_back({first, count, vulkan::Buffer(device, vulkan::BufferUse::Storage, words_bytes, "film"),
                           vulkan::Buffer(device, vulkan::BufferUse::Storage, pass_bytes, "split pass")});
        first += count;
    }
    clear();
}

void Film::clear() {
    for (Strip &strip : strips_) {
        strip.words.clear();
        strip.pass.clear();
    }
}

void Film::read_radiance(double unit, std::uint32_t expected_samples, float *data, std::size_t row_floats) {
    // A piece of a strip at a time, so that a large image is not held twice.
    constexpr std::uint32_t piece_pixels = 1U << 18;
    std::vector<std::uint32_t> words;
    std::vector<float> radiance;
    for (Strip &strip : strips_) {
        for (std::uint32_t first = 0; first < strip.pixel_count; first += piece_pixels) {
            const std::uint32_t count = std::min(piece_pixels, strip.pixel_count - first);
            words.resize(std::size_t{count} * gpu::FILM_WORDS);
            for (std::size_t plane = 0; plane < gpu::FILM_WORDS; ++plane)
                strip.words.download(std::as_writable_bytes(std::span(words).subspan(plane * count, count)),
                                     (plane * strip.pixel_count + first) * sizeof(std::uint32_t));
            radiance.resize(std::size_t{count} * 3);
            mean_radiance(words, count, unit, expected_samples, radiance);
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t pixel = strip.first_pixel + first + i;
                std::copy_n(&radiance[std::size_t{i} * 3], 3, data + pixel / width_ * row_floats + pixel % width_ * 3);
            }
        }
    }
}

std::uint64_t Film::rejected_samples() {
    std::uint64_t total = 0;
    std::vector<std::uint32_t> plane;
    for (Strip &strip : strips_) {
        plane.resize(strip.pixel_count);
        strip.words.download(std::as_writable_bytes(std::span(plane)),
                             std::uint64_t{gpu::FILM_REJECTED} * strip.pixel_count * sizeof(std::uint32_t));
        total = std::accumulate(plane.begin(), plane.end(), total);
    }
    return total;
}

} // namespace pt
