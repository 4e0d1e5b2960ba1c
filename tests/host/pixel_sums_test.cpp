// The quotients of sums of consecutive pixels are those of quotient.h for each pixel.
#include "lib/film/pixel_sums.h"

#include "lib/film/quotient.h"
#include "lib/film/quotient_block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace pixel_sums {

namespace {

using Planes = std::array<std::array<std::uint32_t, pt::gpu::FILM_WORDS>, pt::gpu::FILM_PARTS>;

// Samples of the two parts of nearly all pixels, the unit of their radiance, and the bits of their sums.
struct Usual {
    std::uint32_t a;
    std::uint32_t b;
    int unit_exponent;
    int most_bits;
};

// Sums of which some have few bits, so that their quotients often lie in the middle of two floats, some are none, and
// some have equal or close means in both parts.
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
        const int few = number() % 2 == 0 ? 26 : 128; // of these the leading ones stay
        const pt::WideSum any = (pt::WideSum{number()} << 64 | number()) >> (128 - std::max(bits, 1));
        const int cut = std::max(bits - few, 0);
        return bits == 0 ? 0 : any >> cut << cut;
    }

    Usual usual_;
    std::mt19937_64 random_{11};
};

// Now and then one with other samples.
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

// Of words of all ones and of zeros, which carries pass through and begin at, and others.
TEST(PixelSums, AddAsNumbersOfAllWords) {
    constexpr std::size_t count = 600; // more than are added at a time
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

struct Expected {
    float mean;
    float standard_error;
    float lesser;
};

Expected expected(const Planes &pixel, std::uint32_t channel, int unit_exponent) {
    const int exponent = unit_exponent - static_cast<int>(pt::gpu::FILM_FRACTION_BITS);
    const pt::WideSum sum_a = sum_of(pixel, 0, channel);
    const pt::WideSum sum_b = sum_of(pixel, 1, channel);
    const std::uint32_t a = pixel[0][pt::gpu::FILM_ACCEPTED];
    const std::uint32_t b = pixel[1][pt::gpu::FILM_ACCEPTED];
    const std::uint32_t done = a + b + pixel[0][pt::gpu::FILM_REJECTED] + pixel[1][pt::gpu::FILM_REJECTED];
    const float mean = pt::mean_of(sum_a + sum_b, a + b, exponent);
    if (a == 0 || b == 0 || done < pt::gpu::FILM_MIN_ERROR_SAMPLES)
        return {mean, std::numeric_limits<float>::infinity(), 0.0F};
    const pt::PartDifference parts = pt::PartWeights(a, b).difference(sum_a, sum_b, exponent);
    return {mean, parts.standard_error,
            parts.first_is_less ? pt::mean_of(sum_a, a, exponent) : pt::mean_of(sum_b, b, exponent)};
}

void expect_those_of_each(const Usual &usual) {
    const std::vector<Planes> pixels = random_pixels(8003, usual);
    const pt::PixelSums sums = sums_of(pixels);
    const double unit = std::ldexp(1.0, usual.unit_exponent);
    const pt::PixelEstimates found = sums.estimates(unit, true);
    EXPECT_EQ(sums.estimates(unit, false).radiance, found.radiance);
    const std::size_t count = pixels.size();
    std::vector<float> planes(9 * count);
    const std::uint64_t found_rejected = sums.estimate(
        {0, count, 1, count}, unit, {planes.data(), &planes[3 * count], &planes[6 * count], count, count});
    std::uint64_t rejected = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        for (const auto &part : pixels[i])
            rejected += part[pt::gpu::FILM_REJECTED];
        for (std::uint32_t channel = 0; channel < 3; ++channel) {
            const auto [mean, standard_error, lesser] = expected(pixels[i], channel, usual.unit_exponent);
            EXPECT_EQ(found.radiance[3 * i + channel], mean) << i;
            EXPECT_EQ(found.standard_error[3 * i + channel], standard_error) << i;
            EXPECT_EQ(planes[channel * count + i], mean) << i;
            EXPECT_EQ(planes[(6 + channel) * count + i], lesser) << i;
        }
    }
    EXPECT_EQ(found_rejected, rejected);
}

// Of eight pixels with the same samples at once; weights of one word and of two, and beyond exact products; subnormal
// numbers, those above all floats, and long sums.
TEST(PixelSums, SayOfManyPixelsWhatTheySayOfEach) {
    for (const Usual &usual : {Usual{8, 8, 0, 84},
                               {32, 8, 0, 84},
                               {16, 12, -2, 84},
                               {4096, 4096, 0, 84},
                               {5, 11, 0, 84},
                               {49, 49, 0, 84},
                               {1U << 31, 1U << 30, 0, 84},
                               {1, 1U << 20, 0, 64},
                               {1, (1U << 20) + 1, 0, 70},
                               {8, 1U << 19, 0, 84},
                               {8, 8, -130, 70},
                               {8, 8, 250, 70},
                               {8, 8, 0, 120}}) {
        SCOPED_TRACE(testing::Message() << usual.a << ", " << usual.b << ", 2^" << usual.unit_exponent);
        expect_those_of_each(usual);
    }
}

// Few of them, or blocks would cost time and save none, and none in the middle of two floats where powers of two lose
// nothing. All of subnormal numbers, of those above all floats and of weights whose products are not exact; many of
// long sums, or of sums that are long with their weights.
TEST(PixelSums, OfBlocksAreInDoubtWhereTheyAreUnusual) {
    constexpr std::size_t all = 1000 * pt::block_pixels;
    const struct {
        Usual usual;
        std::size_t least;
        std::size_t most;
    } cases[] = {{{8, 8, 0, 84}, 0, all / 4},    {{49, 49, 0, 84}, 0, all / 4},
                 {{4096, 4096, 0, 52}, 0, 0},    {{8, 8, -130, 70}, all, all},
                 {{8, 8, 250, 70}, all, all},    {{1, (1U << 20) + 1, 0, 70}, all, all},
                 {{8, 8, 0, 128}, all / 8, all}, {{8, 1U << 19, 0, 84}, all / 8, all}};
    for (const auto &[usual, least, most] : cases) {
        RandomSums random(usual);
        const pt::BlockQuotients quotients(usual.a, usual.b, usual.unit_exponent - 60);
        std::size_t doubts = 0;
        for (int i = 0; i < 1000; ++i) {
            std::array<std::array<std::uint32_t, pt::gpu::FILM_SUM_WORDS * pt::block_pixels>, 2> words{};
            for (std::size_t pixel = 0; pixel < pt::block_pixels; ++pixel) {
                const auto sums = random.next();
                for (std::size_t at = pixel; at < words[0].size(); at += pt::block_pixels)
                    for (std::size_t part = 0; part < 2; ++part)
                        words[part][at] = static_cast<std::uint32_t>(sums[part] >> (32 * (at / pt::block_pixels)));
            }
            pt::BlockEstimates estimates{};
            for (const std::uint32_t doubt : quotients.estimates({words[0].data(), pt::block_pixels},
                                                                 {words[1].data(), pt::block_pixels}, estimates))
                doubts += doubt != 0 ? 1 : 0;
        }
        EXPECT_GE(doubts, least) << usual.a << ", " << usual.b << ", 2^" << usual.unit_exponent;
        EXPECT_LE(doubts, most) << usual.a << ", " << usual.b << ", 2^" << usual.unit_exponent;
    }
}

} // namespace

} // namespace pixel_sums
