// Tests of cli/exposure.
#include "cli/image/exposure.h"

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
    EXPECT_EQ(automatic_exposure(grey({0.045F, 0.72F})), 0.0);           // a quarter and four times
    EXPECT_EQ(automatic_exposure(grey({0.18F, 0.18F, 1.44e8F})), -9.86); // a third of log2(8e8)
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
