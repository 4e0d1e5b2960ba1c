// Tests of cli/compare/image_difference on numbers that can be worked out by hand.
#include "cli/compare/image_difference.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace {

using Pixels = std::array<float, 6>; // two

constexpr double relative_offset = 0.01;

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

} // namespace
