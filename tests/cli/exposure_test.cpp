// Tests of cli/exposure.
#include "cli/image/display.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

namespace {

using cli::automatic_exposure;

std::vector<float> grey(std::initializer_list<float> pixels) {
    std::vector<float> radiance;
    for (const float pixel : pixels) {
        radiance.insert(radiance.end(), 3, pixel);
    }
    return radiance;
}

TEST(Exposure, TheAverageOfLogarithmsBecomesMiddleGrey) {
    EXPECT_EQ(automatic_exposure(grey({0.18F})), 0.0);
    EXPECT_EQ(automatic_exposure(grey({0.72F})), -2.0);
    EXPECT_EQ(automatic_exposure(grey({0.09F, 0.36F})), 0.0); // half and twice, with nearly equal weights
    EXPECT_EQ(automatic_exposure(grey({0x1p-20F * 0.09F, 0x1p-20F * 0.36F})), 20.0) << "moves with the picture";
}

// A hundredth of the pixels is a lamp 2^20 times as bright as the rest: the level, by the lamp alone, is 2^20 / 100^4,
// about 0.01 of the rest.
TEST(Exposure, HardlyDependsOnLamps) {
    std::vector<float> radiance = grey({0x1p20F * 0.18F});
    radiance.resize(3 * 100, 0.18F);
    EXPECT_NEAR(automatic_exposure(radiance), -20.0 / 100.0, 0.01);
}

// Half of the picture is a tail of 2^-40: it counts 128 * 2^-40 / level, next to nothing.
TEST(Exposure, WhatLooksBlackDoesNotCount) {
    EXPECT_EQ(automatic_exposure(grey({0.18F, 0x1p-40F, 0.18F, 0x1p-60F})), 0.0);
}

TEST(Exposure, APixelIsTheMeanOfItsChannels) {
    EXPECT_EQ(automatic_exposure(std::array{0.0F, 0.0F, 0.54F}), 0.0); // its luminance is 0.039
    EXPECT_EQ(automatic_exposure(std::array{0.54F, 0.0F, 0.0F}), 0.0);
}

TEST(Exposure, BlackPixelsDoNotCount) {
    EXPECT_EQ(automatic_exposure(grey({0.0F, 0.72F, 0.0F, 0.0F})), -2.0);
    EXPECT_EQ(automatic_exposure(grey({0.0F, 0.0F})), 0.0);
    EXPECT_EQ(automatic_exposure({}), 0.0);
}

TEST(Exposure, IsRoundedAndStaysAmongWhatCanBeGiven) {
    EXPECT_EQ(automatic_exposure(grey({0.5F})), -1.47); // log2(0.18 / 0.5) = -1.474
    EXPECT_EQ(automatic_exposure(grey({std::numeric_limits<float>::max()})), -64.0);
    EXPECT_EQ(automatic_exposure(grey({std::numeric_limits<float>::denorm_min()})), 64.0);
}

} // namespace
