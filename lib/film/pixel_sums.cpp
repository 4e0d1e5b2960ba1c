#include "lib/film/pixel_sums.h"

#include "lib/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace pt {

namespace {

__extension__ using Wide = unsigned __int128;

// Of fewer samples the two parts say next to nothing.
constexpr std::uint64_t min_error_samples = 9;

double fixed_point_value(Wide sum) {
    // unsigned __int128 to double rounds once, to nearest; a power of two does not round again.
    constexpr double last_place = 1.0 / static_cast<double>(Wide{1} << gpu::FILM_FRACTION_BITS);
    return static_cast<double>(sum) * last_place;
}

// One pixel of one part.
class PartPixel {
public:
    PartPixel(const PixelSums &sums, std::uint32_t part, std::size_t pixel) : sums_(sums), part_(part), pixel_(pixel) {}

    std::uint32_t accepted() const { return word(gpu::FILM_ACCEPTED); }
    std::uint64_t done() const { return std::uint64_t{word(gpu::FILM_ACCEPTED)} + word(gpu::FILM_REJECTED); }

    Wide sum(std::size_t channel) const {
        Wide sum = 0;
        for (std::size_t i = gpu::FILM_SUM_WORDS; i-- > 0;)
            sum = sum << 32 | word(channel * gpu::FILM_SUM_WORDS + i);
        return sum;
    }

private:
    std::uint32_t word(std::size_t plane) const { return sums_.plane(part_, plane)[pixel_]; }

    const PixelSums &sums_;
    std::uint32_t part_;
    std::size_t pixel_;
};

// Of a + b samples, whose means are those of the first a and the other b. If every sample has the variance v, the
// square of the difference of the means has the expectation v / a + v / b, and the mean of all has the variance
// v / (a + b): that square times a b / (a + b)^2.
double standard_error(double mean_a, double a, double mean_b, double b) {
    return std::abs(mean_a - mean_b) * std::sqrt(a * b) / (a + b);
}

// Adds the words of one part to those of another, plane by plane: a sum's carries go from each word to the next.
void add_part(PixelSums &to, std::uint32_t to_part, const PixelSums &from, std::uint32_t from_part) {
    std::vector<std::uint32_t> carries(to.pixel_count());
    for (std::size_t plane = 0; plane < gpu::FILM_WORDS; ++plane) {
        if (plane >= gpu::FILM_ACCEPTED || plane % gpu::FILM_SUM_WORDS == 0)
            std::ranges::fill(carries, 0U);
        const std::span<std::uint32_t> words = to.plane(to_part, plane);
        const std::span<const std::uint32_t> others = from.plane(from_part, plane);
        for (std::size_t pixel = 0; pixel < words.size(); ++pixel) {
            const std::uint64_t sum = std::uint64_t{words[pixel]} + others[pixel] + carries[pixel];
            words[pixel] = static_cast<std::uint32_t>(sum);
            carries[pixel] = static_cast<std::uint32_t>(sum >> 32);
        }
    }
}

} // namespace

std::span<std::uint32_t> PixelSums::plane(std::uint32_t part, std::size_t index) {
    return std::span(words_).subspan((std::size_t{part} * gpu::FILM_WORDS + index) * pixel_count_, pixel_count_);
}

std::span<const std::uint32_t> PixelSums::plane(std::uint32_t part, std::size_t index) const {
    return std::span(words_).subspan((std::size_t{part} * gpu::FILM_WORDS + index) * pixel_count_, pixel_count_);
}

void PixelSums::add(const PixelSums &other) {
    for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part)
        add_part(*this, part, other, part);
}

void PixelSums::fold_into(std::uint32_t part) {
    add_part(*this, part, *this, 1 - part);
    for (std::size_t i = 0; i < gpu::FILM_WORDS; ++i)
        std::ranges::fill(plane(1 - part, i), 0U);
}

void PixelSums::swap_parts() {
    for (std::size_t i = 0; i < gpu::FILM_WORDS; ++i)
        std::ranges::swap_ranges(plane(0, i), plane(1, i));
}

void PixelSums::require_samples(const PartCounts &expected) const {
    for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part)
        for (std::size_t pixel = 0; pixel < pixel_count_; ++pixel)
            if (const std::uint64_t done = PartPixel(*this, part, pixel).done(); done != expected[part])
                throw Error(PT_ERROR_INTERNAL, "the driver did " + std::to_string(done) + " of " +
                                                   std::to_string(expected[part]) +
                                                   " samples of a pixel in one part of the film");
}

bool PixelSums::holds(const PartCounts &expected) const {
    for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part)
        for (std::size_t index = 0; index < pixel_count_; ++index) {
            const PartPixel pixel(*this, part, index);
            const Wide bound = Wide{pixel.accepted()} << (gpu::FILM_MAX_EXPONENT + gpu::FILM_FRACTION_BITS);
            const Wide brightest = std::max({pixel.sum(0), pixel.sum(1), pixel.sum(2)});
            if (pixel.done() != expected[part] || brightest > bound)
                return false;
        }
    return true;
}

PixelEstimates PixelSums::estimates(double unit, bool with_standard_error) const {
    PixelEstimates estimates;
    estimates.radiance.reserve(3 * pixel_count_);
    for (auto *const values : {&estimates.standard_error, &estimates.lesser})
        values->reserve(with_standard_error ? 3 * pixel_count_ : 0);
    for (std::size_t pixel = 0; pixel < pixel_count_; ++pixel) {
        const PartPixel a(*this, older_part, pixel);
        const PartPixel b(*this, newer_part, pixel);
        const std::uint32_t accepted = a.accepted() + b.accepted();
        const bool knows_error = a.done() + b.done() >= min_error_samples;
        estimates.rejected += a.done() + b.done() - accepted;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const Wide sum_a = a.sum(channel);
            const Wide sum_b = b.sum(channel);
            const double mean = accepted > 0 ? fixed_point_value(sum_a + sum_b) / accepted : 0.0;
            estimates.radiance.push_back(static_cast<float>(mean * unit));
            if (!with_standard_error)
                continue;
            if (!(knows_error && a.accepted() > 0 && b.accepted() > 0)) {
                estimates.standard_error.push_back(std::numeric_limits<float>::infinity());
                estimates.lesser.push_back(0.0F);
                continue;
            }
            const double mean_a = fixed_point_value(sum_a) / a.accepted();
            const double mean_b = fixed_point_value(sum_b) / b.accepted();
            const double error = standard_error(mean_a, a.accepted(), mean_b, b.accepted());
            estimates.standard_error.push_back(static_cast<float>(error * unit));
            estimates.lesser.push_back(static_cast<float>(std::min(mean_a, mean_b) * unit));
        }
    }
    return estimates;
}

} // namespace pt
