#include "lib/film/pixel_sums.h"

#include "tests/film/random_sums.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace pixel_sums {

namespace {

int compare_shifted(pt::WideSum a, int shift, pt::WideSum b) {
    if (shift < 0)
        return -compare_shifted(b, -shift, a);
    const int room = a >> 64 != 0 ? std::countl_zero(static_cast<std::uint64_t>(a >> 64))
                                  : 64 + std::countl_zero(static_cast<std::uint64_t>(a));
    if (a == 0)
        return b == 0 ? 0 : -1;
    if (shift > room)
        return 1;
    const pt::WideSum shifted = a << shift;
    return shifted < b ? -1 : shifted > b ? 1 : 0;
}

struct Middle {
    pt::WideSum mantissa;
    int exponent;
};

Middle middle_above(std::uint32_t float_bits) {
    const std::uint32_t exponent = float_bits >> 23;
    const std::uint32_t fraction = float_bits & 0x7fffff;
    const std::uint32_t mantissa = exponent > 0 ? fraction + 0x800000 : fraction;
    return {2 * pt::WideSum{mantissa} + 1, static_cast<int>(std::max(exponent, 1U)) - 127 - 23 - 1};
}

// Whether the float is nearest to sum * 2^exponent / count. Ties go to even mantissas.
bool is_nearest(std::uint32_t bits, pt::WideSum sum, std::uint32_t count, int exponent) {
    const bool even = bits % 2 == 0;
    if (bits < 0x7f800000) { // Infinity has no upper midpoint.
        const Middle above = middle_above(bits);
        const int order = compare_shifted(above.mantissa * count, above.exponent - exponent, sum);
        if (order < 0 || (order == 0 && !even))
            return false;
    }
    if (bits == 0)
        return true;
    const Middle below = middle_above(bits - 1);
    const int order = compare_shifted(below.mantissa * count, below.exponent - exponent, sum);
    return order < 0 || (order == 0 && even);
}

// Returns |A b - B a| 2^exponent / ((a + b) sqrt(a b)). The numerator is exact.
long double exact_standard_error(pt::WideSum sum_a, std::uint32_t a, pt::WideSum sum_b, std::uint32_t b, int exponent) {
    const auto multiplied = [](pt::WideSum sum, std::uint32_t factor) {
        const pt::WideSum low = pt::WideSum{static_cast<std::uint64_t>(sum)} * factor;
        const pt::WideSum high = (sum >> 64) * factor + (low >> 64);
        return std::pair(high, static_cast<std::uint64_t>(low));
    };
    auto larger = multiplied(sum_a, b);
    auto smaller = multiplied(sum_b, a);
    if (larger < smaller)
        std::swap(larger, smaller);
    const pt::WideSum high = larger.first - smaller.first - (larger.second < smaller.second ? 1 : 0);
    const std::uint64_t low = larger.second - smaller.second;
    const long double numerator =
        high >> 64 != 0 ? std::ldexp(static_cast<long double>(high), 64) : static_cast<long double>(high << 64 | low);
    const long double sum = static_cast<long double>(a) + b;
    return std::ldexp(numerator / sum / std::sqrt(static_cast<long double>(a) * b), exponent);
}

// Whether `found` is within .52 ulp of `exact`.
bool is_close(float found, long double exact) {
    if (std::isinf(found))
        return exact >= 0x1.ffffffp127L;
    const long double last_place = std::ldexp(1.0L, std::max(std::ilogb(exact == 0 ? 1e-40L : exact), -126) - 23);
    return std::abs(static_cast<long double>(found) - exact) <= 0.52L * last_place;
}

void add(ResolvedPart &to, const ResolvedPart &other) {
    for (std::size_t channel = 0; channel < 3; ++channel)
        to.sums[channel] += other.sums[channel];
    to.accepted += other.accepted;
    to.done += other.done;
}

TEST(PixelSums, AddAsNumbersOfAllWords) {
    std::mt19937 random(1);
    const auto word = [&] {
        return random() % 3 == 0 ? 0U : random() % 2 == 0 ? UINT32_MAX : static_cast<std::uint32_t>(random());
    };
    std::vector<ResolvedPixel> pixels[3];
    for (std::vector<ResolvedPixel> &some : pixels) {
        some.resize(600);
        for (ResolvedPixel &pixel : some)
            for (ResolvedPart &part : pixel.parts) {
                for (pt::WideSum &sum : part.sums)
                    for (std::uint32_t i = 0; i < pt::gpu::FILM_SUM_WORDS; ++i)
                        sum = sum << 32 | word();
                part.accepted = word();
                part.done = word();
            }
    }
    pt::PixelSums sums = film_of(pixels[0]);
    sums.add(film_of(pixels[1]));
    sums.add_part(0, 100, film_of(pixels[2]), 1, 50, 300);
    std::vector<ResolvedPixel> &expected = pixels[0];
    for (std::size_t i = 0; i < expected.size(); ++i) {
        for (const std::uint32_t part : {pt::older_part, pt::newer_part})
            add(expected[i].parts[part], pixels[1][i].parts[part]);
        if (i >= 100 && i < 400)
            add(expected[i].parts[0], pixels[2][i - 50].parts[1]);
    }
    EXPECT_TRUE(sums == film_of(expected));
}

// The smaller mean of both parts is at most the pixel's mean.
TEST(PixelSums, ValuesAreTheNearestFloats) {
    const std::vector<ResolvedPixel> pixels = RandomSums().pixels(50'000);
    const pt::PixelSums sums = film_of(pixels);
    for (const double unit : {1.0, 0x1p-130, 0x1p-100, 0x1p110, 0x1p250}) {
        const int exponent = std::ilogb(unit) - static_cast<int>(pt::gpu::FILM_FRACTION_BITS);
        const std::vector<float> means = sums.values(PT_QUANTITY_RADIANCE, unit);
        const std::vector<float> errors = sums.values(PT_QUANTITY_STANDARD_ERROR, unit);
        pt::PixelValues values(sums, unit);
        for (std::size_t i = 0; i < means.size(); ++i) {
            const auto &[a, b] = pixels[i / 3].parts;
            const pt::WideSum sum_a = a.sums[i % 3];
            const pt::WideSum sum_b = b.sums[i % 3];
            const std::uint32_t count = a.accepted + b.accepted;
            const auto bits = std::bit_cast<std::uint32_t>(means[i]);
            ASSERT_TRUE(is_nearest(bits, sum_a + sum_b, count, exponent)) << means[i] << " of " << count;
            ASSERT_FALSE(std::isfinite(means[i]) && is_nearest(bits + 1, sum_a + sum_b, count, exponent))
                << "the next float must not pass";
            ASSERT_TRUE(is_close(errors[i], exact_standard_error(sum_a, a.accepted, sum_b, b.accepted, exponent)));
            const pt::PixelValue value = values.of(i / 3)[i % 3];
            const auto lesser = std::bit_cast<std::uint32_t>(value.lesser);
            ASSERT_TRUE(value.mean == means[i] && value.standard_error == errors[i] && value.lesser <= means[i]);
            ASSERT_TRUE(is_nearest(lesser, sum_a, a.accepted, exponent) ||
                        is_nearest(lesser, sum_b, b.accepted, exponent));
        }
    }
}

TEST(PixelSums, ErrorsOfFewSamplesAreUnknown) {
    for (const std::uint32_t count : {0U, 1U, pt::gpu::FILM_MIN_ERROR_SAMPLES}) {
        const pt::PixelSums sums = film_of({ResolvedPixel{{{{1, 2, 3}, count, count}, {{}, 0, 0}}}});
        EXPECT_EQ(sums.values(PT_QUANTITY_STANDARD_ERROR, 1.0), std::vector<float>(3, HUGE_VALF)) << count;
        EXPECT_EQ(pt::PixelValues(sums, 1.0).of(0)[2].lesser, 0.0F) << count;
    }
}

TEST(PixelSums, SumsThatNoSamplesHaveAreSeen) {
    const auto hold = [](pt::WideSum sum, std::uint32_t accepted, const pt::PartCounts &expected) {
        return film_of({ResolvedPixel{{{{sum, 0, 0}, accepted, 3}, {{}, 0, 1}}}}).holds(expected);
    };
    const pt::WideSum brightest = pt::WideSum{3} << (pt::gpu::FILM_MAX_EXPONENT + pt::gpu::FILM_FRACTION_BITS);
    EXPECT_TRUE(hold(brightest, 3, {3, 1}));
    EXPECT_FALSE(hold(brightest, 3, {3, 2}));
    EXPECT_FALSE(hold(brightest + 1, 3, {3, 1}));
    EXPECT_FALSE(hold(9, 0, {3, 1})) << "light without accepted samples";
}

} // namespace

} // namespace pixel_sums
