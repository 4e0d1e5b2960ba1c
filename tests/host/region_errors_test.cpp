// What single pixels say about the error of an image, in regions whose result is known.
#include "lib/film/region_errors.h"
#include "shaders/pixel_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

namespace {

constexpr std::size_t side = pt::region_size;
constexpr double many_samples = 1e12;

// One channel of a region; the others are black.
struct Channel {
    std::size_t width;
    std::size_t height;
    std::vector<float> mean;
    std::vector<float> standard_error;
    std::vector<float> lesser;
};

// All pixels have the same mean, which both parts of the film agree on.
Channel flat(float mean) {
    constexpr std::size_t count = side * side;
    return {side, side, std::vector(count, mean), std::vector(count, 0.0F), std::vector(count, mean)};
}

std::size_t index_of(std::size_t x, std::size_t y) {
    return y * side + x;
}

// One of the two parts has all of the pixel's light.
void light_in_one_part(Channel &channel, std::size_t pixel, float mean, float lesser) {
    channel.mean[pixel] = mean;
    channel.standard_error[pixel] = mean - lesser;
    channel.lesser[pixel] = lesser;
}

// After so many samples in every tile.
pt::PixelErrors errors(const Channel &channel, double samples) {
    const auto with_others = [](std::vector<float> values) {
        values.resize(3 * values.size());
        return values;
    };
    const std::vector<float> mean = with_others(channel.mean);
    const std::vector<float> standard_error = with_others(channel.standard_error);
    const std::vector<float> lesser = with_others(channel.lesser);
    const std::vector<double> counts(16, samples);
    pt::PixelErrors errors;
    pt::find_pixel_errors({channel.width, channel.height, channel.width, channel.mean.size(), mean.data(),
                           standard_error.data(), lesser.data()},
                          counts, errors);
    return errors;
}

double relative_square(const Channel &channel, std::size_t pixel) {
    const pt::PixelErrors found = errors(channel, many_samples);
    return found.relative_square[pixel] + found.met_once[pixel];
}

constexpr std::size_t middle = 13 * side + 11;

TEST(ErrorRegion, APixelWhosePartsAgreeIsItsOwnLimit) {
    for (const float ground : {0.0F, 1.0F, 9.0F}) { // a bright or dark spot
        Channel channel = flat(ground);
        channel.mean[middle] = 3.0F;
        channel.lesser[middle] = 2.875F;
        channel.standard_error[middle] = 0.125F;
        const double limit = ground > 2.875F ? 9.0 : 2.875 * 2.875;
        EXPECT_DOUBLE_EQ(relative_square(channel, middle), 0.015625 / (limit + 0.01)) << ground;
    }
}

TEST(ErrorRegion, AFireflyIsMeasuredByWhatIsAboutIt) {
    Channel channel = flat(0.5F);
    light_in_one_part(channel, middle, 8.0F, 0.5F);
    EXPECT_DOUBLE_EQ(relative_square(channel, middle), 7.5 * 7.5 / (0.25 + 0.01));
    light_in_one_part(channel, middle, 8.0F, 0.0F); // the other part knows less than the pixels about
    EXPECT_DOUBLE_EQ(relative_square(channel, middle), 64.0 / 0.26);
}

// All of the light in one part of the film, or at least a quarter of the mean in either; not where it is as bright
// about.
TEST(ErrorRegion, WhatStandsOutIsMetOnceOrAgain) {
    for (const auto &[ground, lesser, once, again] : {std::tuple{0.5F, 0.0F, 1.0, 0.0},
                                                      {0.5F, 0.0625F, 1.0, 0.0},
                                                      {0.5F, 0.25F, 0.0, 0.0},
                                                      {0.5F, 2.0F, 0.0, 1.0},
                                                      {4.0F, 0.0F, 0.0, 0.0},
                                                      {4.0F, 2.0F, 0.0, 0.0}}) {
        Channel channel = flat(ground);
        light_in_one_part(channel, middle, 8.0F, lesser);
        const pt::PixelErrors found = errors(channel, many_samples);
        const double error = 8.0 - static_cast<double>(lesser);
        EXPECT_DOUBLE_EQ(found.as_lamps[middle], once * error * error / 64.01) << ground << " " << lesser;
        EXPECT_EQ(found.met_once[middle] > 0.0, once > 0.0);
        EXPECT_EQ(found.relative_square[middle] > 0.0, once == 0.0);
        EXPECT_EQ(found.met_again[middle], again);
    }
}

// Where hits are rare and most pixels are black, the level is the mean of the tile, of 64 pixels, without the brightest
// of the others; where one of those has most of the tile's light, it is that of the region.
TEST(ErrorRegion, AmongRareHitsTheLevelIsThatOfTheTileOrTheRegion) {
    Channel channel = flat(0.0F);
    for (const std::size_t x : {8, 11, 14})
        light_in_one_part(channel, index_of(x, 9), 16.0F, 0.0F);
    double level = 16.0 / 62.0; // of two others, one is left out
    EXPECT_DOUBLE_EQ(relative_square(channel, index_of(8, 9)), 256.0 / (level * level + 0.01));

    channel = flat(0.0F);
    for (std::size_t tile = 0; tile < 4; ++tile)
        for (const std::size_t x : {1, 6})
            light_in_one_part(channel, index_of(8 * tile + x, 4), 64.0F, 0.0F);
    level = 64.0 * 6.0 / 1022.0; // of seven others, one is left out; in the tile there is one other
    EXPECT_DOUBLE_EQ(relative_square(channel, index_of(1, 4)), 64.0 * 64.0 / (level * level + 0.01));
}

// At the edge of something bright, one sample of which hit the pixel: integrated over what share of it is bright.
TEST(ErrorRegion, AnEdgePixelCountsMoreThanItsOwnMeanSays) {
    Channel channel = flat(100.0F);
    light_in_one_part(channel, middle, 5.0F, 0x1p-10F);
    const double square = (5.0 - 0x1p-10) * (5.0 - 0x1p-10);
    EXPECT_NEAR(relative_square(channel, middle), square / 25.01 * 0.5 * std::log(25.01 / (0.01 + 0x1p-20)), 1e-12);
}

// Nor does a part with less than half of the samples that saw nothing say that little was bright: of samples 0 to 35 it
// has four.
TEST(ErrorRegion, AFewDarkSamplesMakeNoEdge) {
    Channel channel = flat(5.0F);
    channel.mean[middle] = 4.0F;
    channel.lesser[middle] = 0.0F;
    channel.standard_error[middle] = 4.0F * std::sqrt(4.0F / 32.0F);
    EXPECT_FLOAT_EQ(static_cast<float>(relative_square(channel, middle)), 2.0F / 16.01F);
    channel.standard_error[middle] = 4.0F * std::sqrt(32.0F / 4.0F); // the other part, with 32, saw nothing
    EXPECT_FLOAT_EQ(static_cast<float>(relative_square(channel, middle)),
                    128.0F / 16.01F * 0.5F * std::log(16.01F / 0.01F));
}

// The integral that shaders/pixel_error.h derives, taken numerically: the logarithm less about 0.6.
TEST(ErrorRegion, TheFactorOfAnEdgeIsTheLogarithmOfAnIntegralButForAConstant) {
    constexpr double euler = 0.5772;
    for (const double ratio : {100.0, 1e4, 1e6}) { // T / k
        double integral = 0.0;
        constexpr double step = 1e-3;
        for (double log_y = -30.0 + 0.5 * step; log_y < 5.0; log_y += step) {
            const double y = std::exp(log_y);
            integral += step * y * y * std::exp(-y) / (y * y + 1.0 / (ratio * ratio));
        }
        EXPECT_NEAR(integral, std::log(ratio) - euler, 3.0 / ratio + 1e-4) << ratio;
    }
}

TEST(ErrorRegion, UnseenLightIsExpectedOnlyBesideBrighterPixels) {
    Channel channel = flat(1.0F);
    channel.mean[middle] = 1000.0F;
    constexpr double samples = 64.0;
    const pt::PixelErrors found = errors(channel, samples);
    const double b = 1000.0 / samples / std::sqrt(1.01);
    const double expected = 0.05 * b * b / (std::sqrt(samples) * (3.0 + 0.81 * b + 0.9 * std::pow(b, 1.5)));
    for (std::size_t y = 10; y < 17; ++y)
        for (std::size_t x = 8; x < 15; ++x) {
            const bool beside = x >= 10 && x <= 12 && y >= 12 && y <= 14 && index_of(x, y) != middle;
            EXPECT_NEAR(found.unseen[index_of(x, y)], beside ? expected : 0.0, 1e-12) << x << " " << y;
        }
    for (const double unseen : errors(channel, 1024.0).unseen) // a sample of 1000 would show
        EXPECT_EQ(unseen, 0.0);
}

// The integral over p from 0 to 1 / N of 0.05 / (2 sqrt(p)) times p / N / (a^2 + p^2), in steps of s = sqrt(p).
TEST(ErrorRegion, UnseenLightIsTheExpectationOverCorners) {
    constexpr double samples = 64.0;
    for (const double b : {1.01, 2.0, 10.0, 100.0, 1e4, 1e6}) {
        const double a = 1.0 / (samples * b);
        constexpr int steps = 1'000'000;
        const double step = std::sqrt(1.0 / samples) / steps;
        double integral = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double p = (i + 0.5) * step * (i + 0.5) * step;
            integral += 0.05 * step * p / samples / (a * a + p * p);
        }
        const double found = pt::gpu::unseen_square(0.0, b * samples, samples, 1.0);
        EXPECT_LT(found, 1.006 * integral) << b;
        EXPECT_GT(found, 0.857 * integral) << b;
    }
}

// A small piece of an image is a region too, down to a pixel, of which the darker part alone tells the limit.
TEST(ErrorRegion, MayBeAsSmallAsAPixel) {
    for (const std::size_t width : {1, 2, 9})
        for (const std::size_t height : {1, 2, 9}) {
            const std::size_t count = width * height;
            Channel channel{width, height, std::vector(count, 2.0F), std::vector(count, 0.5F),
                            std::vector(count, 1.5F)};
            const double limit = count == 1 ? 2.25 : 4.0;
            const pt::PixelErrors found = errors(channel, many_samples);
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t pixel = index_of(i % width, i / width);
                EXPECT_EQ(found.square[pixel], 0.25);
                EXPECT_DOUBLE_EQ(found.relative_square[pixel], 0.25 / (limit + 0.01));
            }
            light_in_one_part(channel, 0, 8.0F, 1.0F);
            const double dark = count == 1 ? 1.0 : 4.0; // the neighbours have 2
            EXPECT_DOUBLE_EQ(relative_square(channel, 0), 49.0 / (dark + 0.01)) << width << " x " << height;
        }
}

} // namespace
