// Tests of cli/compare/image_difference on numbers that can be worked out by hand.
#include "cli/compare/image_difference.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace {

using Pixels = std::array<float, 6>; // two

constexpr double relative_offset = 0.01;

TEST(ImageDifference, EqualImagesDoNotDiffer) {
    const Pixels image{0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 1e30F};
    const cli::ImageDifference difference = cli::compare_images(image, image);
    EXPECT_EQ(difference.mse, 0.0);
    EXPECT_EQ(difference.relative_mse, 0.0);
    EXPECT_EQ(difference.maximum, 0.0);
    EXPECT_EQ(difference.not_finite, 0U);
}

TEST(ImageDifference, FiguresAreMeansOverPixelsAndChannels) {
    const Pixels reference{0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F};
    const Pixels image{0.0F, 0.0F, 1.5F, 0.0F, -2.0F, 0.0F};
    const cli::ImageDifference difference = cli::compare_images(image, reference);
    const double first = 0.25 / (1.0 + relative_offset) / 3.0;
    const double second = 4.0 / relative_offset / 3.0;
    EXPECT_DOUBLE_EQ(difference.mse, (0.25 + 4.0) / 6.0);
    EXPECT_DOUBLE_EQ(difference.relative_mse, (first + second) / 2.0);
    EXPECT_EQ(difference.maximum, 2.0);
    EXPECT_EQ(difference.maximum_value, 4U);
}

TEST(ImageDifference, TheReferenceIsWhatDifferencesAreRelativeTo) {
    const std::array<float, 3> dark{0.0F, 0.0F, 0.0F};
    const std::array<float, 3> bright{1.0F, 1.0F, 1.0F};
    EXPECT_DOUBLE_EQ(cli::compare_images(dark, bright).relative_mse, 1.0 / (1.0 + relative_offset));
    EXPECT_DOUBLE_EQ(cli::compare_images(bright, dark).relative_mse, 1.0 / relative_offset);
}

TEST(ImageDifference, PixelsThatAreNotFiniteAreCountedAndLeftOut) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const Pixels good{1.0F, 1.0F, 1.0F, 2.0F, 2.0F, 2.0F};
    for (const float bad : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
        const Pixels image{1.0F, bad, 1.0F, 2.0F, 2.5F, 2.0F};
        for (const auto &difference : {cli::compare_images(image, good), cli::compare_images(good, image)}) {
            EXPECT_EQ(difference.not_finite, 1U);
            EXPECT_DOUBLE_EQ(difference.mse, 0.25 / 3.0);
            EXPECT_EQ(difference.maximum, 0.5);
        }
        EXPECT_EQ(cli::compare_images(image, image).not_finite, 1U); // not even equal to itself
        const Pixels worse{bad, bad, bad, bad, 0.0F, 0.0F};
        EXPECT_EQ(cli::compare_images(worse, good).not_finite, 2U);
        EXPECT_EQ(cli::compare_images(worse, good).mse, 0.0);
    }
}

} // namespace
