#include "lib/film/pixel_sums.h"

#include "tests/film/exact_quotient.h"
#include "tests/film/random_sums.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace pixel_sums {

namespace {

using Planes = std::array<std::array<std::uint32_t, pt::gpu::FILM_WORDS>, pt::gpu::FILM_PARTS>;

pt::PixelSums sums_of(const std::vector<Planes> &pixels) {
    pt::PixelSums sums;
    sums.resize(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i)
        for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part)
            for (std::uint32_t plane = 0; plane < pt::gpu::FILM_WORDS; ++plane)
                sums.plane(part, plane)[i] = pixels[i][part][plane];
    return sums;
}

pt::WideSum sum_of(const Planes &pixel, std::uint32_t part, std::uint32_t channel) {
    pt::WideSum sum = 0;
    for (std::uint32_t word = pt::gpu::FILM_SUM_WORDS; word-- > 0;)
        sum = sum << 32 | pixel[part][channel * pt::gpu::FILM_SUM_WORDS + word];
    return sum;
}

TEST(PixelSums, AddAsNumbersOfAllWords) {
    constexpr std::size_t count = 600;
    std::mt19937 random(1);
    std::vector<Planes> pixels[3];
    for (std::vector<Planes> &some : pixels) {
        some.resize(count);
        for (Planes &pixel : some)
            for (auto &part : pixel)
                for (std::uint32_t &word : part)
                    word = random() % 3 == 0   ? 0U
                           : random() % 2 == 0 ? UINT32_MAX
                                               : static_cast<std::uint32_t>(random());
    }
    pt::PixelSums sums = sums_of(pixels[0]);
    sums.add(sums_of(pixels[1]));
    const pt::PixelSums others = sums_of(pixels[2]);
    sums.add_part(0, 100, others, 1, 50, 300);
    for (std::size_t i = 0; i < count; ++i)
        for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part) {
            const bool is_added = part == 0 && i >= 100 && i < 400;
            Planes found{};
            for (std::uint32_t plane = 0; plane < pt::gpu::FILM_WORDS; ++plane)
                found[part][plane] = sums.plane(part, plane)[i];
            for (std::uint32_t channel = 0; channel < 3; ++channel)
                ASSERT_TRUE(sum_of(found, part, channel) == sum_of(pixels[0][i], part, channel) +
                                                                sum_of(pixels[1][i], part, channel) +
                                                                (is_added ? sum_of(pixels[2][i - 50], 1, channel) : 0))
                    << i;
            for (const std::uint32_t plane : {pt::gpu::FILM_ACCEPTED, pt::gpu::FILM_REJECTED})
                ASSERT_EQ(found[part][plane], pixels[0][i][part][plane] + pixels[1][i][part][plane] +
                                                  (is_added ? pixels[2][i - 50][1][plane] : 0))
                    << i;
        }
}

// The smaller mean of both parts is at most the pixel's mean.
TEST(PixelSums, ValuesAreTheNearestFloats) {
    RandomSums random;
    std::vector<ResolvedPixel> pixels(50'000);
    std::ranges::generate(pixels, [&] { return random.pixel(); });
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
            const auto bits = std::bit_cast<std::uint32_t>(means[i]);
            ASSERT_TRUE(is_nearest(bits, sum_a + sum_b, a.accepted + b.accepted, exponent)) << means[i];
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
        pt::PixelSums sums = film_of({ResolvedPixel{{{{1, 2, 3}, count}, {{}, 0}}}});
        for (const std::uint32_t part : {pt::older_part, pt::newer_part})
            sums.plane(part, pt::gpu::FILM_REJECTED)[0] = 0;
        EXPECT_EQ(sums.values(PT_QUANTITY_STANDARD_ERROR, 1.0), std::vector<float>(3, HUGE_VALF)) << count;
        EXPECT_EQ(pt::PixelValues(sums, 1.0).of(0)[2].lesser, 0.0F) << count;
    }
}

} // namespace

} // namespace pixel_sums
