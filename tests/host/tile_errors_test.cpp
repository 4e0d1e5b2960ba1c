// What single pixels say about the error of an image, in tiles whose result is known.
#include "lib/film/tile_errors.h"
#include "shaders/pixel_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <tuple>

namespace {

constexpr double many_samples = 1e12;

// All pixels have the same mean in one channel, which both parts of the film agree on; the others are black.
pt::TileValues flat(float mean, std::size_t width = pt::tile_size, std::size_t height = pt::tile_size) {
    pt::TileValues tile{.width = width, .height = height, .sample_count = many_samples};
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            tile.mean[0][y * pt::tile_size + x] = tile.lesser[0][y * pt::tile_size + x] = mean;
    return tile;
}

std::size_t index_of(std::size_t x, std::size_t y) {
    return y * pt::tile_size + x;
}

void set_pixel(pt::TileValues &tile, std::size_t pixel, float mean, float standard_error, float lesser) {
    tile.mean[0][pixel] = mean;
    tile.standard_error[0][pixel] = standard_error;
    tile.lesser[0][pixel] = lesser;
}

// One of the two parts has all of the pixel's light.
void light_in_one_part(pt::TileValues &tile, std::size_t pixel, float mean, float lesser) {
    set_pixel(tile, pixel, mean, mean - lesser, lesser);
}

double relative_square(const pt::TileValues &tile, std::size_t pixel) {
    const pt::PixelErrors found = pt::pixel_errors(tile);
    return found.relative_square[pixel] + found.met_once[pixel];
}

constexpr std::size_t middle = 4 * pt::tile_size + 3;

TEST(TileErrors, APixelWhosePartsAgreeIsItsOwnLimit) {
    for (const float ground : {0.0F, 1.0F, 9.0F}) { // a bright or dark spot
        pt::TileValues tile = flat(ground);
        set_pixel(tile, middle, 3.0F, 0.125F, 2.875F);
        const double limit = ground > 2.875F ? 9.0 : 2.875 * 2.875;
        EXPECT_DOUBLE_EQ(relative_square(tile, middle), 0.015625 / (limit + 0.01)) << ground;
    }
}

TEST(TileErrors, AFireflyIsMeasuredByWhatIsAboutIt) {
    pt::TileValues tile = flat(0.5F);
    light_in_one_part(tile, middle, 8.0F, 0.5F);
    EXPECT_DOUBLE_EQ(relative_square(tile, middle), 7.5 * 7.5 / (0.25 + 0.01));
    light_in_one_part(tile, middle, 8.0F, 0.0F); // the other part knows less than the pixels about
    EXPECT_DOUBLE_EQ(relative_square(tile, middle), 64.0 / 0.26);
}

// All of the light in one part of the film, or at least a quarter of the mean in either; not where it is as bright
// about.
TEST(TileErrors, WhatStandsOutIsMetOnceOrAgain) {
    for (const auto &[ground, lesser, once, again] : {std::tuple{0.5F, 0.0F, 1.0, 0.0},
                                                      {0.5F, 0.0625F, 1.0, 0.0},
                                                      {0.5F, 0.25F, 0.0, 0.0},
                                                      {0.5F, 2.0F, 0.0, 1.0},
                                                      {4.0F, 0.0F, 0.0, 0.0},
                                                      {4.0F, 2.0F, 0.0, 0.0}}) {
        pt::TileValues tile = flat(ground);
        light_in_one_part(tile, middle, 8.0F, lesser);
        const pt::PixelErrors found = pt::pixel_errors(tile);
        const double error = 8.0 - static_cast<double>(lesser);
        EXPECT_DOUBLE_EQ(found.as_lamps[middle], once * error * error / 64.01) << ground << " " << lesser;
        EXPECT_EQ(found.met_once[middle] > 0.0, once > 0.0);
        EXPECT_EQ(found.relative_square[middle] > 0.0, once == 0.0);
        EXPECT_EQ(found.met_again[middle], again);
    }
}

// Where hits are rare and most pixels are black, the level is the mean of the others without the brightest of them.
TEST(TileErrors, AmongRareHitsTheLevelIsThatOfTheTile) {
    pt::TileValues tile = flat(0.0F);
    for (const std::size_t x : {0, 3, 6})
        light_in_one_part(tile, index_of(x, 1), 16.0F, 0.0F);
    const double level = 16.0 / 62.0; // of two others, one is left out
    EXPECT_DOUBLE_EQ(relative_square(tile, index_of(0, 1)), 256.0 / (level * level + 0.01));
}

// The mean of the pixels about it is at least an eighth of the brightest of them. A pixel that is darker than that
// mean lies at an edge.
TEST(TileErrors, BesideABrighterPixelTheLevelIsAnEighthOfThat) {
    pt::TileValues tile = flat(0.0F);
    set_pixel(tile, middle, 64.0F, 0.0F, 64.0F);
    light_in_one_part(tile, middle + 1, 32.0F, 0.0F);
    light_in_one_part(tile, middle + 3, 32.0F, 0.0F); // which the bright pixel does not touch
    EXPECT_DOUBLE_EQ(relative_square(tile, middle + 1), 32.0 * 32.0 / (8.0 * 8.0 + 0.01));
    EXPECT_GT(relative_square(tile, middle + 3), 32.0 * 32.0 / 1.0);
    light_in_one_part(tile, middle + 1, 4.0F, 0.0F);
    EXPECT_NEAR(relative_square(tile, middle + 1), 16.0 / 16.01 * 0.5 * std::log(16.01 / 0.01), 1e-12);
}

// At the edge of something bright, one sample of which hit the pixel: integrated over what share of it is bright.
TEST(TileErrors, AnEdgePixelCountsMoreThanItsOwnMeanSays) {
    pt::TileValues tile = flat(100.0F);
    light_in_one_part(tile, middle, 5.0F, 0x1p-10F);
    const double square = (5.0 - 0x1p-10) * (5.0 - 0x1p-10);
    EXPECT_NEAR(relative_square(tile, middle), square / 25.01 * 0.5 * std::log(25.01 / (0.01 + 0x1p-20)), 1e-12);
}

// Nor does a part with less than half of the samples that saw nothing say that little was bright: of samples 0 to 35 it
// has four.
TEST(TileErrors, AFewDarkSamplesMakeNoEdge) {
    pt::TileValues tile = flat(5.0F);
    set_pixel(tile, middle, 4.0F, 4.0F * std::sqrt(4.0F / 32.0F), 0.0F);
    EXPECT_FLOAT_EQ(static_cast<float>(relative_square(tile, middle)), 2.0F / 16.01F);
    set_pixel(tile, middle, 4.0F, 4.0F * std::sqrt(32.0F / 4.0F), 0.0F); // the other part, with 32, saw nothing
    EXPECT_FLOAT_EQ(static_cast<float>(relative_square(tile, middle)),
                    128.0F / 16.01F * 0.5F * std::log(16.01F / 0.01F));
}

// The integral that shaders/pixel_error.h derives, taken numerically: the logarithm less about 0.6.
TEST(TileErrors, TheFactorOfAnEdgeIsTheLogarithmOfAnIntegralButForAConstant) {
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

TEST(TileErrors, UnseenLightIsExpectedOnlyBesideBrighterPixels) {
    pt::TileValues tile = flat(1.0F);
    tile.mean[0][middle] = 1000.0F;
    constexpr double samples = 64.0;
    tile.sample_count = samples;
    const pt::PixelErrors found = pt::pixel_errors(tile);
    const double b = 1000.0 / samples / std::sqrt(1.01);
    const double expected = 0.055 * b * b / (std::sqrt(samples) * (3.0 + 0.81 * b + 0.9 * std::pow(b, 1.5)));
    for (std::size_t y = 0; y < pt::tile_size; ++y)
        for (std::size_t x = 0; x < pt::tile_size; ++x) {
            const bool beside = x >= 2 && x <= 4 && y >= 3 && y <= 5 && index_of(x, y) != middle;
            EXPECT_NEAR(found.unseen[index_of(x, y)], beside ? expected : 0.0, 1e-12) << x << " " << y;
        }
    tile.sample_count = 1024.0; // a sample of 1000 would show
    for (const double unseen : pt::pixel_errors(tile).unseen)
        EXPECT_EQ(unseen, 0.0);
}

// The integral over p from 0 to 1 / N of 0.055 / (2 sqrt(p)) times p / N / (a^2 + p^2), in steps of s = sqrt(p).
TEST(TileErrors, UnseenLightIsTheExpectationOverCorners) {
    constexpr double samples = 64.0;
    for (const double b : {1.01, 2.0, 10.0, 100.0, 1e4, 1e6}) {
        const double a = 1.0 / (samples * b);
        constexpr int steps = 1'000'000;
        const double step = std::sqrt(1.0 / samples) / steps;
        double integral = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double p = (i + 0.5) * step * (i + 0.5) * step;
            integral += 0.055 * step * p / samples / (a * a + p * p);
        }
        const double found = pt::gpu::unseen_square(0.0, b * samples, samples, 1.0);
        EXPECT_LT(found, 1.006 * integral) << b;
        EXPECT_GT(found, 0.857 * integral) << b;
    }
}

// Down to a pixel, of which the darker part alone tells the limit.
TEST(TileErrors, OfTilesAsSmallAsAPixel) {
    for (const std::size_t width : {1, 2, 7})
        for (const std::size_t height : {1, 2, 7}) {
            const bool is_pixel = width * height == 1;
            pt::TileValues tile = flat(2.0F, width, height);
            for (std::size_t i = 0; i < width * height; ++i)
                set_pixel(tile, index_of(i % width, i / width), 2.0F, 0.5F, 1.5F);
            const double limit = is_pixel ? 2.25 : 4.0;
            const pt::PixelErrors found = pt::pixel_errors(tile);
            for (std::size_t i = 0; i < width * height; ++i) {
                const std::size_t pixel = index_of(i % width, i / width);
                EXPECT_EQ(found.square[pixel], 0.25);
                EXPECT_DOUBLE_EQ(found.relative_square[pixel], 0.25 / (limit + 0.01));
            }
            light_in_one_part(tile, 0, 8.0F, 1.0F);
            const double dark = is_pixel ? 1.0 : 4.0; // the neighbours have 2
            EXPECT_DOUBLE_EQ(relative_square(tile, 0), 49.0 / (dark + 0.01)) << width << " x " << height;
        }
}

} // namespace
