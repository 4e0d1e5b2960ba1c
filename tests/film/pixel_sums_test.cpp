#include "lib/film/pixel_sums.h"

#include "shaders/quotient.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace pixel_sums {

namespace {

using Planes = std::array<std::array<std::uint32_t, pt::gpu::FILM_WORDS>, pt::gpu::FILM_PARTS>;

struct Usual {
    std::uint32_t a;
    std::uint32_t b;
    int unit_exponent;
    int most_bits;
};

// Sums with few bits have quotients midway between floats. Some means of a pixel's parts are equal or nearly equal.
class RandomSums {
public:
    explicit RandomSums(const Usual &usual) : usual_(usual) {}

    std::uint64_t number() { return random_(); }

    std::array<pt::WideSum, 2> next() {
        const pt::WideSum mean = number() % (1U << 25) | 1U;
        if (number() % 4 == 0 && mean * std::max(usual_.a, usual_.b) >> (usual_.most_bits - 1) <= 1)
            return {mean * usual_.a, mean * usual_.b};
        const pt::WideSum first = sum();
        return {first, number() % 4 == 0 ? first + number() % 3 : sum()};
    }

private:
    pt::WideSum sum() {
        const int bits = static_cast<int>(number() % static_cast<std::uint64_t>(usual_.most_bits + 1));
        const int few = number() % 2 == 0 ? 26 : 128;
        const pt::WideSum any = (pt::WideSum{number()} << 64 | number()) >> (128 - std::max(bits, 1));
        const int cut = std::max(bits - few, 0);
        return bits == 0 ? 0 : any >> cut << cut;
    }

    Usual usual_;
    std::mt19937_64 random_{11};
};

std::vector<Planes> random_pixels(std::size_t count, const Usual &usual) {
    RandomSums random(usual);
    std::vector<Planes> pixels(count);
    for (Planes &pixel : pixels) {
        for (std::uint32_t channel = 0; channel < 3; ++channel) {
            const auto sums = random.next();
            for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part)
                for (std::uint32_t word = 0; word < pt::gpu::FILM_SUM_WORDS; ++word)
                    pixel[part][channel * pt::gpu::FILM_SUM_WORDS + word] =
                        static_cast<std::uint32_t>(sums[part] >> (32 * word));
        }
        pixel[0][pt::gpu::FILM_ACCEPTED] = usual.a;
        pixel[1][pt::gpu::FILM_ACCEPTED] = usual.b;
        if (random.number() % 100 == 0)
            pixel[random.number() % 2][pt::gpu::FILM_ACCEPTED] = static_cast<std::uint32_t>(random.number() % 5);
        if (random.number() % 100 == 0)
            pixel[random.number() % 2][pt::gpu::FILM_REJECTED] = 3;
    }
    return pixels;
}

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

pt::gpu::uvec4 words_of(pt::WideSum sum) {
    return {static_cast<std::uint32_t>(sum), static_cast<std::uint32_t>(sum >> 32),
            static_cast<std::uint32_t>(sum >> 64), static_cast<std::uint32_t>(sum >> 96)};
}

// Extreme sums, and sums whose quotients are ties between floats or next to ties.
std::vector<pt::WideSum> close_to_ties(std::uint32_t count) {
    std::vector<pt::WideSum> sums{0, 1, 2, 3, ~pt::WideSum{0}, ~pt::WideSum{0} - 1, pt::WideSum{1} << 127};
    for (const std::uint32_t tie : {(1U << 24) + 1, (1U << 24) + 3, (1U << 25) - 3, (1U << 25) - 1, (1U << 24) + 2})
        for (int shift = 0; shift <= 70; ++shift) {
            const pt::WideSum sum = pt::WideSum{tie} * count << shift;
            sums.insert(sums.end(), {sum - 1, sum, sum + 1});
        }
    return sums;
}

TEST(Divisor, RoundsAsKernelsDo) {
    for (const std::uint32_t count : {0U, 1U, 2U, 3U, 4U, 5U, 7U, 100U, 1U << 16, (1U << 16) + 1, 1U << 31,
                                      (1U << 31) + 1, UINT32_MAX - 1, UINT32_MAX})
        for (const int exponent : {-1300, -250, -200, -190, -175, -150, -60, 0, 30, 100, 1300}) {
            const pt::Divisor divisor(count, exponent);
            for (const pt::WideSum sum : close_to_ties(count))
                ASSERT_EQ(std::bit_cast<std::uint32_t>(divisor.quotient(sum)),
                          pt::gpu::mean_bits(words_of(sum), count, exponent))
                    << count << ", 2^" << exponent << ", " << static_cast<double>(sum);
        }
}

pt::PixelValue expected(const Planes &pixel, std::uint32_t channel, int unit_exponent) {
    const int exponent = unit_exponent - static_cast<int>(pt::gpu::FILM_FRACTION_BITS);
    const pt::WideSum sum_a = sum_of(pixel, 0, channel);
    const pt::WideSum sum_b = sum_of(pixel, 1, channel);
    const std::uint32_t a = pixel[0][pt::gpu::FILM_ACCEPTED];
    const std::uint32_t b = pixel[1][pt::gpu::FILM_ACCEPTED];
    const std::uint32_t done = a + b + pixel[0][pt::gpu::FILM_REJECTED] + pixel[1][pt::gpu::FILM_REJECTED];
    const auto mean_of = [exponent](pt::WideSum sum, std::uint32_t count) {
        return std::bit_cast<float>(pt::gpu::mean_bits(words_of(sum), count, exponent));
    };
    const float mean = mean_of(sum_a + sum_b, a + b);
    if (a == 0 || b == 0 || done < pt::gpu::FILM_MIN_ERROR_SAMPLES)
        return {mean, std::numeric_limits<float>::infinity(), 0.0F};
    bool first_is_less = false;
    const pt::gpu::WholeNumber numerator =
        pt::gpu::weighted_difference(words_of(sum_a), a, words_of(sum_b), b, first_is_less);
    const std::uint32_t error = pt::gpu::standard_error_bits(numerator, pt::gpu::error_divisor(a, b), exponent);
    return {mean, std::bit_cast<float>(error), first_is_less ? mean_of(sum_a, a) : mean_of(sum_b, b)};
}

void expect_those_of_kernels(const Usual &usual) {
    const std::vector<Planes> pixels = random_pixels(8003, usual);
    const pt::PixelSums sums = sums_of(pixels);
    const double unit = std::ldexp(1.0, usual.unit_exponent);
    const std::vector<float> means = sums.values(PT_QUANTITY_RADIANCE, unit);
    const std::vector<float> errors = sums.values(PT_QUANTITY_STANDARD_ERROR, unit);
    pt::PixelValues values(sums, unit);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        for (std::uint32_t channel = 0; channel < 3; ++channel) {
            const auto [mean, standard_error, lesser] = expected(pixels[i], channel, usual.unit_exponent);
            EXPECT_EQ(means[3 * i + channel], mean) << i;
            EXPECT_EQ(errors[3 * i + channel], standard_error) << i;
            EXPECT_EQ(values.of(i)[channel].mean, mean) << i;
            EXPECT_EQ(values.of(i)[channel].standard_error, standard_error) << i;
            EXPECT_EQ(values.of(i)[channel].lesser, lesser) << i;
        }
}

TEST(PixelSums, HaveTheValuesOfKernels) {
    for (const Usual &usual : {Usual{8, 8, 0, 84},
                               {32, 8, 0, 84},
                               {16, 12, -2, 84},
                               {4096, 4096, 0, 84},
                               {5, 11, 0, 84},
                               {49, 49, 0, 84},
                               {1U << 31, 1U << 30, 0, 84},
                               {1U << 31, 1U << 30, 0, 100},
                               {1, 1U << 20, 0, 64},
                               {1, (1U << 20) + 1, 0, 70},
                               {8, 1U << 19, 0, 84},
                               {8, 8, -130, 70},
                               {8, 8, 250, 70},
                               {8, 8, 0, 120}}) {
        SCOPED_TRACE(testing::Message() << usual.a << ", " << usual.b << ", 2^" << usual.unit_exponent);
        expect_those_of_kernels(usual);
    }
}

} // namespace

} // namespace pixel_sums
