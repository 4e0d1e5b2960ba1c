#include "lib/film/pixel_sums.h"

#include "lib/base/error.h"
#include "lib/film/part_words.h"
#include "lib/film/quotient.h"
#include "lib/film/quotient_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace pt {

namespace {

// The sums of one pixel in one part.
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

// Estimates adjacent pixels, in blocks.
class Estimation {
public:
    Estimation(const PixelSums &sums, double unit, const EstimatePlanes &to) :
        sums_(sums),
        exponent_(std::ilogb(unit) - static_cast<int>(gpu::FILM_FRACTION_BITS)),
        to_(to) {}

    // Samples left out.
    std::uint64_t rejected() const { return rejected_; }

    // to_first: the index of the first result.
    void estimate(std::size_t first, std::size_t count, std::size_t to_first) {
        if (count == block_pixels && estimate_alike(first, to_first))
            return;
        for (std::size_t i = 0; i < count; ++i) {
            const PartPixel a(sums_, older_part, first + i);
            const PartPixel b(sums_, newer_part, first + i);
            rejected_ += a.done() + b.done() - a.accepted() - b.accepted();
            for (std::size_t channel = 0; channel < 3; ++channel)
                estimate_one(first + i, to_first + i, channel);
        }
    }

private:
    const std::uint32_t *words(std::uint32_t part, std::size_t plane, std::size_t pixel) const {
        return sums_.plane(part, plane).subspan(pixel).data();
    }

    // For a block whose pixels all have the same samples and none was left out, which is nearly every block.
    bool estimate_alike(std::size_t first, std::size_t to_first) {
        const std::uint32_t *const a = words(older_part, gpu::FILM_ACCEPTED, first);
        const std::uint32_t *const b = words(newer_part, gpu::FILM_ACCEPTED, first);
        const std::uint32_t *const rejected_a = words(older_part, gpu::FILM_REJECTED, first);
        const std::uint32_t *const rejected_b = words(newer_part, gpu::FILM_REJECTED, first);
        std::uint32_t others = 0;
        for (std::size_t i = 0; i < block_pixels; ++i)
            others |= (a[i] ^ a[0]) | (b[i] ^ b[0]) | rejected_a[i] | rejected_b[i];
        const std::uint64_t samples = std::uint64_t{*a} + *b;
        if (others != 0 || *a == 0 || *b == 0 || samples < gpu::FILM_MIN_ERROR_SAMPLES || samples > UINT32_MAX)
            return false;
        if (!quotients_ || !quotients_->are_of(*a, *b))
            quotients_.emplace(*a, *b, exponent_);
        for (std::size_t channel = 0; channel < 3; ++channel)
            estimate_alike(first, to_first, channel);
        return true;
    }

    void estimate_alike(std::size_t first, std::size_t to_first, std::size_t channel) {
        const std::size_t plane = channel * gpu::FILM_SUM_WORDS;
        const BlockSums a{words(older_part, plane, first), sums_.pixel_count()};
        const BlockSums b{words(newer_part, plane, first), sums_.pixel_count()};
        const std::size_t to = channel * to_.stride + to_first;
        BlockEstimates found;
        const bool with_error = to_.standard_error != nullptr;
        const BlockDoubts doubts =
            with_error ? quotients_->estimates(a, b, found) : quotients_->means(a, b, found.mean);
        std::ranges::copy(found.mean, to_.radiance + to);
        if (with_error) {
            std::ranges::copy(found.standard_error, to_.standard_error + to);
            std::ranges::copy(found.lesser, to_.lesser + to);
        }
        if (has_any(doubts))
            for (std::size_t i = 0; i < block_pixels; ++i)
                if (doubts[i] != 0)
                    estimate_one(first + i, to_first + i, channel);
    }

    // By quotient.h, which works for any sums.
    void estimate_one(std::size_t pixel, std::size_t to, std::size_t channel) {
        const PartPixel a(sums_, older_part, pixel);
        const PartPixel b(sums_, newer_part, pixel);
        const WideSum sum_a = a.sum(channel);
        const WideSum sum_b = b.sum(channel);
        to += channel * to_.stride;
        to_.radiance[to] = mean_of(sum_a + sum_b, a.accepted() + b.accepted(), exponent_);
        if (to_.standard_error == nullptr)
            return;
        if (a.done() + b.done() < gpu::FILM_MIN_ERROR_SAMPLES || a.accepted() == 0 || b.accepted() == 0) {
            to_.standard_error[to] = std::numeric_limits<float>::infinity();
            to_.lesser[to] = 0.0F;
            return;
        }
        if (!weights_ || !weights_->are_of(a.accepted(), b.accepted()))
            weights_.emplace(a.accepted(), b.accepted());
        const PartDifference parts = weights_->difference(sum_a, sum_b, exponent_);
        to_.standard_error[to] = parts.standard_error;
        to_.lesser[to] =
            parts.first_is_less ? mean_of(sum_a, a.accepted(), exponent_) : mean_of(sum_b, b.accepted(), exponent_);
    }

    const PixelSums &sums_;
    int exponent_;
    EstimatePlanes to_;
    std::uint64_t rejected_ = 0;
    std::optional<BlockQuotients> quotients_; // of the block before: most have the same samples
    std::optional<PartWeights> weights_;      // likewise of the pixel before
};

} // namespace

void PixelSums::clear() noexcept {
    std::ranges::fill(words_, 0U);
}

void PixelSums::add(const PixelSums &other) noexcept {
    for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part)
        add_part(part, 0, other, part, 0, pixel_count_);
}

void PixelSums::add_part(std::uint32_t to_part, std::size_t to_first, const PixelSums &from, std::uint32_t from_part,
                         std::size_t first, std::size_t count) noexcept {
    add_words({plane(to_part, 0).data() + to_first, pixel_count_},
              {from.plane(from_part, 0).data() + first, from.pixel_count_}, count);
}

void PixelSums::fold_into(std::uint32_t part, std::size_t first, std::size_t count) noexcept {
    add_part(part, first, *this, 1 - part, first, count);
    for (std::size_t i = 0; i < gpu::FILM_WORDS; ++i)
        std::ranges::fill(plane(1 - part, i).subspan(first, count), 0U);
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

// In blocks whose planes fit into the fastest cache.
PixelEstimates PixelSums::estimates(double unit, bool with_standard_error) const {
    constexpr std::size_t most = 256;
    std::array<float, 9 * most> planes;
    const EstimatePlanes to{planes.data(), with_standard_error ? &planes[3 * most] : nullptr, &planes[6 * most], most,
                            most};
    PixelEstimates estimates;
    estimates.radiance.resize(3 * pixel_count_);
    estimates.standard_error.resize(with_standard_error ? 3 * pixel_count_ : 0);
    for (std::size_t first = 0; first < pixel_count_; first += most) {
        const std::size_t count = std::min(most, pixel_count_ - first);
        estimate({first, count, 1, count}, unit, to);
        const auto interleave = [&](const float *from, std::vector<float> &values) {
            for (std::size_t i = 0; i < count && !values.empty(); ++i)
                for (std::size_t channel = 0; channel < 3; ++channel)
                    values[3 * (first + i) + channel] = from[channel * most + i];
        };
        interleave(to.radiance, estimates.radiance);
        interleave(to.standard_error, estimates.standard_error);
    }
    return estimates;
}

std::uint64_t PixelSums::estimate(const PixelRows &pixels, double unit, const EstimatePlanes &to) const {
    Estimation estimation(*this, unit, to);
    for (std::size_t y = 0; y < pixels.height; ++y)
        for (std::size_t x = 0; x < pixels.width; x += block_pixels)
            estimation.estimate(pixels.first + y * pixels.stride + x, std::min(block_pixels, pixels.width - x),
                                y * to.row_stride + x);
    return estimation.rejected();
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
