// The quotients of sums of consecutive pixels are those of quotient.h for each pixel.
#include "lib/film/pixel_sums.h"

#include "lib/film/quotient.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace pixel_sums {

namespace {

using Planes = std::array<std::array<std::uint32_t, pt::gpu::FILM_WORDS>, pt::gpu::FILM_PARTS>;

// Pixels in runs with the same samples, now and then one with others, or with sums beyond the usual.
std::vector<Planes> random_pixels(std::size_t count) {
    std::mt19937 random(11);
    std::vector<Planes> pixels(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part) {
            auto &words = pixels[i][part];
            for (std::uint32_t channel = 0; channel < 3; ++channel) {
                std::uint32_t *const sum = &words[channel * pt::gpu::FILM_SUM_WORDS];
                sum[0] = random() % 2 == 0 ? 0 : static_cast<std::uint32_t>(random());
                sum[1] = static_cast<std::uint32_t>(random()) & 0xffffff00;
                sum[2] = static_cast<std::uint32_t>(random() % 4);
                sum[3] = random() % 200 == 0 ? 5 : 0;
            }
            const bool is_odd = random() % 100 == 0;
            words[pt::gpu::FILM_ACCEPTED] = is_odd ? static_cast<std::uint32_t>(random() % 5) : i < count / 2 ? 16 : 12;
            words[pt::gpu::FILM_REJECTED] = random() % 100 == 0 ? 3 : 0;
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

struct Expected {
    float mean;
    float standard_error;
    float lesser;
};

// In film units of 1 / 4.
Expected expected(const Planes &pixel, std::uint32_t channel) {
    constexpr int exponent = -2 - static_cast<int>(pt::gpu::FILM_FRACTION_BITS);
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

TEST(PixelSums, SayOfManyPixelsWhatTheySayOfEach) {
    const std::vector<Planes> pixels = random_pixels(3003);
    const pt::PixelSums sums = sums_of(pixels);
    const pt::PixelEstimates found = sums.estimates(0.25, true);
    EXPECT_EQ(sums.estimates(0.25, false).radiance, found.radiance);
    const std::size_t count = pixels.size();
    std::vector<float> planes(9 * count);
    const std::uint64_t found_rejected = sums.estimate(
        {0, count, 1, count}, 0.25, {planes.data(), &planes[3 * count], &planes[6 * count], count, count});
    std::uint64_t rejected = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        for (const auto &part : pixels[i])
            rejected += part[pt::gpu::FILM_REJECTED];
        for (std::uint32_t channel = 0; channel < 3; ++channel) {
            const auto [mean, standard_error, lesser] = expected(pixels[i], channel);
            EXPECT_EQ(found.radiance[3 * i + channel], mean) << i;
            EXPECT_EQ(found.standard_error[3 * i + channel], standard_error) << i;
            EXPECT_EQ(planes[channel * count + i], mean) << i;
            EXPECT_EQ(planes[(6 + channel) * count + i], lesser) << i;
        }
    }
    EXPECT_EQ(found_rejected, rejected);
}

} // namespace

} // namespace pixel_sums
