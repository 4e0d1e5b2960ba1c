#include "lib/film/pixel_sums.h"

#include "lib/base/error.h"
#include "lib/film/quotient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace pt {

namespace {

// One pixel of one part.
class PartPixel {
public:
    PartPixel(const PixelSums &sums, std::uint32_t part, std::size_t pixel) : sums_(sums), part_(part), pixel_(pixel) {}

    std::uint32_t accepted() const { return word(gpu::FILM_ACCEPTED); }
    std::uint64_t done() const { return std::uint64_t{word(gpu::FILM_ACCEPTED)} + word(gpu::FILM_REJECTED); }

    WideSum sum(std::size_t channel) const {
        WideSum sum = 0;
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

// Pixels whose carries are kept at a time: in the fastest cache, and in no memory that might be lacking.
constexpr std::size_t carry_block = 1024;

} // namespace

std::span<std::uint32_t> PixelSums::plane(std::uint32_t part, std::size_t index) {
    return std::span(words_).subspan((std::size_t{part} * gpu::FILM_WORDS + index) * pixel_count_, pixel_count_);
}

std::span<const std::uint32_t> PixelSums::plane(std::uint32_t part, std::size_t index) const {
    return std::span(words_).subspan((std::size_t{part} * gpu::FILM_WORDS + index) * pixel_count_, pixel_count_);
}

void PixelSums::add(const PixelSums &other) noexcept {
    for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part)
        add_part(part, 0, other, part, 0, pixel_count_);
}

// Plane by plane: a sum's carries go from each word to the next.
void PixelSums::add_part(std::uint32_t to_part, std::size_t to_first, const PixelSums &from, std::uint32_t from_part,
                         std::size_t first, std::size_t count) noexcept {
    std::array<std::uint32_t, carry_block> carries;
    for (std::size_t done = 0; done < count; done += carry_block) {
        const std::size_t block = std::min(carry_block, count - done);
        for (std::size_t plane = 0; plane < gpu::FILM_WORDS; ++plane) {
            if (plane >= gpu::FILM_ACCEPTED || plane % gpu::FILM_SUM_WORDS == 0)
                std::ranges::fill_n(carries.begin(), static_cast<std::ptrdiff_t>(block), 0U);
            const std::span<std::uint32_t> words = this->plane(to_part, plane).subspan(to_first + done, block);
            const std::span<const std::uint32_t> others = from.plane(from_part, plane).subspan(first + done, block);
            for (std::size_t pixel = 0; pixel < block; ++pixel) {
                const std::uint64_t sum = std::uint64_t{words[pixel]} + others[pixel] + carries[pixel];
                words[pixel] = static_cast<std::uint32_t>(sum);
                carries[pixel] = static_cast<std::uint32_t>(sum >> 32);
            }
        }
    }
}

void PixelSums::fold_into(std::uint32_t part) noexcept {
    add_part(part, 0, *this, 1 - part, 0, pixel_count_);
    for (std::size_t i = 0; i < gpu::FILM_WORDS; ++i)
        std::ranges::fill(plane(1 - part, i), 0U);
}

void PixelSums::swap_parts() {
    for (std::size_t i = 0; i < gpu::FILM_WORDS; ++i)
        std::ranges::swap_ranges(plane(0, i), plane(1, i));
}

void PixelSums::copy(const PixelSums &from, std::size_t first, std::size_t count, std::size_t to_first) noexcept {
    for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part)
        for (std::size_t i = 0; i < gpu::FILM_WORDS; ++i)
            std::ranges::copy(from.plane(part, i).subspan(first, count), plane(part, i).subspan(to_first).begin());
}

PartCounts PixelSums::samples_of(std::size_t pixel) const {
    return {PartPixel(*this, 0, pixel).done(), PartPixel(*this, 1, pixel).done()};
}

void require_samples(const PartCounts &done, const PartCounts &expected) {
    for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part)
        if (done[part] != expected[part])
            throw Error(PT_ERROR_INTERNAL, "the driver did " + std::to_string(done[part]) + " of " +
                                               std::to_string(expected[part]) +
                                               " samples of a pixel in one part of the film");
}

bool PixelSums::holds(const PartCounts &expected) const {
    for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part)
        for (std::size_t index = 0; index < pixel_count_; ++index) {
            const PartPixel pixel(*this, part, index);
            const WideSum bound = WideSum{pixel.accepted()} << (gpu::FILM_MAX_EXPONENT + gpu::FILM_FRACTION_BITS);
            const WideSum brightest = std::max({pixel.sum(0), pixel.sum(1), pixel.sum(2)});
            if (pixel.done() != expected[part] || brightest > bound)
                return false;
        }
    return true;
}

PixelEstimates PixelSums::estimates(double unit, bool with_standard_error) const {
    PixelEstimates estimates;
    estimates.radiance.resize(3 * pixel_count_);
    for (auto *const values : {&estimates.standard_error, &estimates.lesser})
        values->resize(with_standard_error ? 3 * pixel_count_ : 0);
    estimates.rejected = estimate(0, unit, {estimates.radiance, estimates.standard_error, estimates.lesser});
    return estimates;
}

std::uint64_t PixelSums::estimate(std::size_t first, double unit, const EstimateSpans &to) const {
    const int exponent = std::ilogb(unit) - static_cast<int>(gpu::FILM_FRACTION_BITS);
    const bool with_standard_error = !to.standard_error.empty();
    std::uint64_t rejected = 0;
    std::optional<PartWeights> weights; // of the pixel before: most have the same
    for (std::size_t i = 0; i < to.radiance.size(); i += 3) {
        const PartPixel a(*this, older_part, first + i / 3);
        const PartPixel b(*this, newer_part, first + i / 3);
        const std::uint32_t accepted = a.accepted() + b.accepted();
        const bool knows_error =
            a.done() + b.done() >= gpu::FILM_MIN_ERROR_SAMPLES && a.accepted() > 0 && b.accepted() > 0;
        rejected += a.done() + b.done() - accepted;
        if (with_standard_error && knows_error && !(weights && weights->are_of(a.accepted(), b.accepted())))
            weights.emplace(a.accepted(), b.accepted());
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const WideSum sum_a = a.sum(channel);
            const WideSum sum_b = b.sum(channel);
            to.radiance[i + channel] = mean_of(sum_a + sum_b, accepted, exponent);
            if (!with_standard_error)
                continue;
            if (!knows_error) {
                to.standard_error[i + channel] = std::numeric_limits<float>::infinity();
                to.lesser[i + channel] = 0.0F;
                continue;
            }
            const PartDifference parts = weights->difference(sum_a, sum_b, exponent);
            to.standard_error[i + channel] = parts.standard_error;
            to.lesser[i + channel] =
                parts.first_is_less ? mean_of(sum_a, a.accepted(), exponent) : mean_of(sum_b, b.accepted(), exponent);
        }
    }
    return rejected;
}

std::vector<float> PixelSums::sample_counts() const {
    std::vector<float> counts;
    counts.reserve(3 * pixel_count_);
    for (std::size_t pixel = 0; pixel < pixel_count_; ++pixel) {
        const auto [older, newer] = samples_of(pixel);
        counts.insert(counts.end(), 3, static_cast<float>(older + newer));
    }
    return counts;
}

} // namespace pt
