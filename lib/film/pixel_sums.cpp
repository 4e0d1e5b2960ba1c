#include "lib/film/pixel_sums.h"

#include "lib/base/error.h"

#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace pt {

namespace {

class PartPixel {
public:
    PartPixel(const PixelSums &sums, std::uint32_t part, std::size_t pixel) : sums_(sums), part_(part), pixel_(pixel) {}

    std::uint32_t accepted() const { return word(gpu::FILM_ACCEPTED); }
    std::uint64_t done() const { return std::uint64_t{word(gpu::FILM_ACCEPTED)} + word(gpu::FILM_REJECTED); }

    WideSum sum(std::size_t channel) const {
        static_assert(gpu::FILM_SUM_WORDS == 4);
        const std::size_t first = channel * gpu::FILM_SUM_WORDS;
        return WideSum{two_words(first + 2)} << 64 | two_words(first);
    }

private:
    std::uint64_t two_words(std::size_t plane) const { return std::uint64_t{word(plane + 1)} << 32 | word(plane); }
    std::uint32_t word(std::size_t plane) const { return sums_.plane(part_, plane)[pixel_]; }

    const PixelSums &sums_;
    std::uint32_t part_;
    std::size_t pixel_;
};

struct WordAndCarry {
    std::uint32_t word;
    std::uint32_t carry;
};

// 32-bit arithmetic lets compilers vectorise over pixels.
WordAndCarry sum_of(std::uint32_t a, std::uint32_t b, std::uint32_t carry) {
    const std::uint32_t sum = a + b;
    const std::uint32_t with_carry = sum + carry;
    return {with_carry, static_cast<std::uint32_t>(sum < a) | static_cast<std::uint32_t>(with_carry < sum)};
}

} // namespace

void PixelSums::clear() noexcept {
    std::ranges::fill(words_, 0U);
}

void PixelSums::add(const PixelSums &other) noexcept {
    for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part)
        add_part(part, 0, other, part, 0, pixel_count_);
    add_coverage(0, other, 0, pixel_count_);
}

// Works plane by plane, because carries go from one word of a sum to the next.
void PixelSums::add_part(std::uint32_t to_part, std::size_t to_first, const PixelSums &from, std::uint32_t from_part,
                         std::size_t first, std::size_t count) noexcept {
    constexpr std::size_t block_pixels = 256; // fits the fastest cache
    std::array<std::uint32_t, block_pixels> carries;
    for (std::size_t done = 0; done < count; done += block_pixels) {
        const std::size_t block = std::min(block_pixels, count - done);
        for (std::size_t i = 0; i < gpu::FILM_WORDS; ++i) {
            if (i >= gpu::FILM_ACCEPTED || i % gpu::FILM_SUM_WORDS == 0)
                std::fill_n(carries.begin(), block, 0U);
            std::uint32_t *const words = plane(to_part, i).data() + to_first + done;
            const std::uint32_t *const others = from.plane(from_part, i).data() + first + done;
            for (std::size_t pixel = 0; pixel < block; ++pixel) {
                const WordAndCarry result = sum_of(words[pixel], others[pixel], carries[pixel]);
                words[pixel] = result.word;
                carries[pixel] = result.carry;
            }
        }
    }
}

void PixelSums::add_coverage(std::size_t to_first, const PixelSums &from, std::size_t first,
                             std::size_t count) noexcept {
    if (!has_coverage_ || !from.has_coverage_)
        return;
    const auto own = plane(gpu::FILM_COVERED).subspan(to_first, count);
    std::ranges::transform(own, from.plane(gpu::FILM_COVERED).subspan(first, count), own.begin(), std::plus());
}

void PixelSums::fold_into(std::uint32_t part, std::size_t first, std::size_t count) noexcept {
    add_part(part, first, *this, 1 - part, first, count);
    for (std::size_t i = 0; i < gpu::FILM_WORDS; ++i)
        std::ranges::fill(plane(1 - part, i).subspan(first, count), 0U);
}

void PixelSums::copy(const PixelSums &from, std::size_t first, std::size_t count, std::size_t to_first) noexcept {
    for (std::size_t i = 0, count_of_planes = std::min(plane_count(), from.plane_count()); i < count_of_planes; ++i)
        std::ranges::copy(from.plane(i).subspan(first, count), plane(i).subspan(to_first).begin());
}

void PixelSums::copy(const Rectangle &own, const PixelSums &from, const Rectangle &of_from) noexcept {
    const auto [x, top, width, height] = common(own, of_from);
    for (std::uint32_t y = top; y < top + height; ++y)
        copy(from, of_from.index_of(x, y), width, own.index_of(x, y));
}

void PixelSums::split_for(const SampleSet &samples, std::uint64_t split, std::size_t first,
                          std::size_t count) noexcept {
    const std::uint64_t own = split_of(samples.hull());
    if (!samples.empty() && own != split)
        fold_into(own < split ? older_part : newer_part, first, count);
}

PartCounts PixelSums::samples_of(std::size_t pixel) const {
    return {PartPixel(*this, 0, pixel).done(), PartPixel(*this, 1, pixel).done()};
}

void require_samples(const PartCounts &done, const PartCounts &expected) {
    for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part)
        if (done[part] != expected[part])
            throw Error(PT_ERROR_INTERNAL, "the driver took " + std::to_string(done[part]) + " of " +
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
    const std::uint64_t all = expected[older_part] + expected[newer_part];
    return !has_coverage_ ||
           std::ranges::all_of(plane(gpu::FILM_COVERED), [&](std::uint32_t count) { return count <= all; });
}

std::vector<float> PixelSums::values(std::uint32_t quantity, double unit) const {
    std::vector<float> values;
    values.reserve(3 * pixel_count_);
    PixelValues found(*this, unit);
    for (std::size_t pixel = 0; pixel < pixel_count_; ++pixel)
        if (quantity == PT_QUANTITY_RADIANCE) {
            const auto means = found.means(pixel);
            values.insert(values.end(), means.begin(), means.end());
        } else if (quantity == PT_QUANTITY_STANDARD_ERROR) {
            for (const PixelValue &value : found.of(pixel))
                values.push_back(value.standard_error);
        } else {
            const auto [older, newer] = samples_of(pixel);
            const float value =
                quantity == PT_QUANTITY_COVERAGE
                    ? Divisor(static_cast<std::uint32_t>(older + newer), 0).quotient(plane(gpu::FILM_COVERED)[pixel])
                    : static_cast<float>(older + newer);
            values.insert(values.end(), 3, value);
        }
    return values;
}

PixelValues::PixelValues(const PixelSums &sums, double unit) :
    sums_(sums),
    exponent_(std::ilogb(unit) - static_cast<int>(gpu::FILM_FRACTION_BITS)),
    quotients_(1, 1, exponent_) {}

void PixelValues::show(std::uint32_t a, std::uint32_t b) {
    if (!quotients_.are_of(a, b))
        quotients_ = PartQuotients(a, b, exponent_);
}

std::array<float, 3> PixelValues::means(std::size_t pixel) {
    const PartPixel a(sums_, older_part, pixel);
    const PartPixel b(sums_, newer_part, pixel);
    show(a.accepted(), b.accepted());
    std::array<float, 3> means;
    for (std::size_t channel = 0; channel < 3; ++channel)
        means[channel] = quotients_.mean(a.sum(channel), b.sum(channel));
    return means;
}

std::array<PixelValue, 3> PixelValues::of(std::size_t pixel) {
    const PartPixel a(sums_, older_part, pixel);
    const PartPixel b(sums_, newer_part, pixel);
    show(a.accepted(), b.accepted());
    const bool is_known = a.done() + b.done() >= gpu::FILM_MIN_ERROR_SAMPLES && a.accepted() > 0 && b.accepted() > 0;
    std::array<PixelValue, 3> values;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const WideSum sum_a = a.sum(channel);
        const WideSum sum_b = b.sum(channel);
        const auto [standard_error, lesser] =
            is_known ? quotients_.difference(sum_a, sum_b)
                     : PartQuotients::Difference{std::numeric_limits<float>::infinity(), 0.0F};
        values[channel] = {quotients_.mean(sum_a, sum_b), standard_error, lesser};
    }
    return values;
}

} // namespace pt
