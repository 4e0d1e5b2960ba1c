// Layout and read-out of the film; see film.h.
#include "lib/film/film.h"

#include "lib/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace pt {

namespace {

__extension__ using Wide = unsigned __int128;

Wide wide_of_words(const std::uint32_t words[gpu::FILM_SUM_WORDS]) {
    const Wide low = words[0] | Wide{words[1]} << 32;
    const Wide high = words[2] | Wide{words[3]} << 32;
    return low | high << 64;
}

double fixed_point_value(Wide sum) {
    // unsigned __int128 to double rounds once, to nearest; a power of two does not round again.
    constexpr double last_place = 1.0 / static_cast<double>(Wide{1} << gpu::FILM_FRACTION_BITS);
    return static_cast<double>(sum) * last_place;
}

// The words of one pixel in one part of the film.
class PartPixel {
public:
    PartPixel(std::span<const std::uint32_t> words, std::size_t plane_pixels, std::size_t part, std::size_t pixel) :
        words_(words.subspan(part * gpu::FILM_WORDS * plane_pixels)),
        plane_pixels_(plane_pixels),
        pixel_(pixel) {}

    std::uint32_t accepted() const { return word(gpu::FILM_ACCEPTED); }
    std::uint32_t done() const { return word(gpu::FILM_ACCEPTED) + word(gpu::FILM_REJECTED); }

    Wide sum(std::size_t channel) const {
        std::array<std::uint32_t, gpu::FILM_SUM_WORDS> sum{};
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] = word(channel * gpu::FILM_SUM_WORDS + i);
        return wide_of_words(sum.data());
    }

private:
    std::uint32_t word(std::size_t plane) const { return words_[plane * plane_pixels_ + pixel_]; }

    std::span<const std::uint32_t> words_;
    std::size_t plane_pixels_;
    std::size_t pixel_;
};

void require_samples(const PartPixel &pixel, std::uint32_t expected) {
    if (pixel.done() != expected)
        throw Error(PT_ERROR_INTERNAL, "the driver did " + std::to_string(pixel.done()) + " of " +
                                           std::to_string(expected) + " samples of a pixel in one part of the film");
}

// Of a mean over a + b samples, from the means of its first a and its other b. If every sample has the variance v, the
// square of their difference has the expectation v / a + v / b, and the mean has the variance v / (a + b): that square
// times a b / (a + b)^2.
double standard_error(double sum_a, double a, double sum_b, double b) {
    if (a == 0.0 || b == 0.0)
        return std::numeric_limits<double>::infinity();
    return std::abs(sum_a / a - sum_b / b) * std::sqrt(a * b) / (a + b);
}

} // namespace

PixelEstimates pixel_estimates(std::span<const std::uint32_t> words, std::size_t plane_pixels, double unit,
                               const PartCounts &expected, bool with_standard_error) {
    PixelEstimates estimates;
    estimates.radiance.reserve(3 * plane_pixels);
    estimates.standard_error.reserve(with_standard_error ? 3 * plane_pixels : 0);
    for (std::size_t pixel = 0; pixel < plane_pixels; ++pixel) {
        const PartPixel a(words, plane_pixels, 0, pixel);
        const PartPixel b(words, plane_pixels, 1, pixel);
        require_samples(a, expected[0]);
        require_samples(b, expected[1]);
        const std::uint32_t accepted = a.accepted() + b.accepted();
        estimates.rejected += a.done() + b.done() - accepted;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const Wide sum_a = a.sum(channel);
            const Wide sum_b = b.sum(channel);
            const double mean = accepted > 0 ? fixed_point_value(sum_a + sum_b) / accepted : 0.0;
            estimates.radiance.push_back(static_cast<float>(mean * unit));
            if (!with_standard_error)
                continue;
            const double error =
                standard_error(fixed_point_value(sum_a), a.accepted(), fixed_point_value(sum_b), b.accepted());
            estimates.standard_error.push_back(static_cast<float>(error * unit));
        }
    }
    return estimates;
}

std::uint32_t max_strip_pixels(const vulkan::Limits &limits) {
    const std::uint64_t bytes = std::min<std::uint64_t>(limits.max_storage_buffer_range, limits.max_allocation_bytes);
    const std::uint64_t pixels = bytes / (Film::words_per_pixel * sizeof(std::uint32_t));
    const std::uint64_t dispatched = std::uint64_t{limits.max_workgroup_count} * gpu::WORKGROUP_SIZE;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>({pixels, dispatched, UINT32_MAX}));
}

Film::Film(vulkan::Device &device, std::uint32_t width, std::uint32_t height, std::uint32_t max_strip_pixels) :
    width_(width),
    height_(height) {
    for (std::uint32_t first = 0; first < pixel_count();) {
        const std::uint32_t count = std::min(max_strip_pixels, pixel_count() - first);
        const std::uint64_t words_bytes = count * words_per_pixel * sizeof(std::uint32_t);
        const std::uint64_t pass_bytes = std::uint64_t{count} * sizeof(glm::vec4);
        strips_.push_back({first, count, vulkan::Buffer(device, vulkan::BufferUse::Storage, words_bytes, "film"),
                           vulkan::Buffer(device, vulkan::BufferUse::Storage, pass_bytes, "split pass")});
        first += count;
    }
}

void Film::clear(const vk::raii::CommandBuffer &commands, std::uint32_t first_pixel, std::uint32_t pixel_count) {
    for (const Strip &strip : strips_) {
        const std::uint64_t first = std::max(first_pixel, strip.first_pixel);
        const std::uint64_t end = std::min(first_pixel + pixel_count, strip.first_pixel + strip.pixel_count);
        if (first >= end)
            continue;
        for (const vulkan::Buffer *buffer : {&strip.words, &strip.pass}) {
            const std::uint64_t share = buffer->size() / strip.pixel_count; // bytes
            buffer->clear(commands, (first - strip.first_pixel) * share, (end - first) * share);
        }
    }
    older_end_ = min_older_samples;
}

void Film::download(std::uint32_t first_pixel, std::uint32_t pixel_count, std::span<std::uint32_t> words) {
    std::vector<vulkan::BufferPiece> pieces(words_per_pixel);
    for (Strip &strip : strips_) {
        const std::uint32_t first = std::max(first_pixel, strip.first_pixel);
        const std::uint32_t end = std::min(first_pixel + pixel_count, strip.first_pixel + strip.pixel_count);
        if (first >= end)
            continue;
        for (std::size_t plane = 0; plane < words_per_pixel; ++plane)
            pieces[plane] = {
                std::as_writable_bytes(words.subspan(plane * pixel_count + (first - first_pixel), end - first)),
                (plane * strip.pixel_count + (first - strip.first_pixel)) * sizeof(std::uint32_t)};
        strip.words.download(pieces);
    }
}

namespace {

// Adds another part's words of the same pixels, plane by plane: a sum's carries go from each word to the next.
void add_part(std::span<std::uint32_t> words, std::span<const std::uint32_t> other, std::size_t plane_pixels) {
    std::vector<std::uint32_t> carries(plane_pixels);
    for (std::size_t plane = 0; plane < gpu::FILM_WORDS; ++plane) {
        if (plane >= gpu::FILM_ACCEPTED || plane % gpu::FILM_SUM_WORDS == 0)
            std::ranges::fill(carries, 0U);
        for (std::size_t pixel = 0; pixel < plane_pixels; ++pixel) {
            std::uint32_t &word = words[plane * plane_pixels + pixel];
            const std::uint64_t sum = std::uint64_t{word} + other[plane * plane_pixels + pixel] + carries[pixel];
            word = static_cast<std::uint32_t>(sum);
            carries[pixel] = static_cast<std::uint32_t>(sum >> 32);
        }
    }
}

void add_film(std::span<std::uint32_t> words, std::span<const std::uint32_t> other, std::size_t plane_pixels) {
    const std::size_t part_words = gpu::FILM_WORDS * plane_pixels;
    for (std::size_t part = 0; part < gpu::FILM_PARTS; ++part)
        add_part(words.subspan(part * part_words, part_words), other.subspan(part * part_words, part_words),
                 plane_pixels);
}

// What fold.comp does, for a film whose device has taken no sample since.
void fold_parts(std::span<std::uint32_t> words, std::size_t plane_pixels) {
    const std::span<std::uint32_t> newer = words.subspan(gpu::FILM_WORDS * plane_pixels);
    add_part(words.first(gpu::FILM_WORDS * plane_pixels), newer, plane_pixels);
    std::ranges::fill(newer, 0U);
}

} // namespace

void read_films(std::span<Film *const> films, double unit, const PartCounts &expected, bool with_standard_error,
                const std::function<void(const PixelEstimates &)> &receive) {
    // A piece at a time, so that a large image is not held twice. Were planes a power of two apart, the words of a
    // pixel would contend for one set of the processor's cache.
    constexpr std::uint32_t piece_pixels = 130'000;
    const std::uint32_t pixel_count = films.front()->pixel_count();
    std::vector<std::uint32_t> words;
    std::vector<std::uint32_t> others;
    for (std::uint32_t first = 0; first < pixel_count; first += std::min(piece_pixels, pixel_count - first)) {
        const std::uint32_t count = std::min(piece_pixels, pixel_count - first);
        const auto read = [&](Film &film, std::vector<std::uint32_t> &into) {
            into.resize(count * Film::words_per_pixel);
            film.download(first, count, into);
            if (film.older_end() < expected[0])
                fold_parts(into, count);
        };
        read(*films.front(), words);
        for (Film *film : films.subspan(1)) {
            read(*film, others);
            add_film(words, others, count);
        }
        receive(pixel_estimates(words, count, unit, expected, with_standard_error));
    }
}

std::uint64_t Film::rejected_samples() {
    std::uint64_t total = 0;
    std::vector<std::uint32_t> plane;
    for (Strip &strip : strips_) {
        plane.resize(strip.pixel_count);
        for (std::size_t part = 0; part < gpu::FILM_PARTS; ++part) {
            const std::uint64_t index = part * gpu::FILM_WORDS + gpu::FILM_REJECTED;
            strip.words.download(std::as_writable_bytes(std::span(plane)),
                                 index * strip.pixel_count * sizeof(std::uint32_t));
            total = std::accumulate(plane.begin(), plane.end(), total);
        }
    }
    return total;
}

} // namespace pt
