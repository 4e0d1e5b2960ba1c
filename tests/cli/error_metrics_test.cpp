// Tests of cli/error_metrics on cases that can be worked out by hand.
#include "cli/compare/image_difference.h"

#include <gtest/gtest.h>

#include <array>

namespace {

using cli::image_error;

TEST(ErrorMetrics, EqualImagesHaveNoError) {
    const std::array image{0.0F, 0.5F, 1e30F};
    EXPECT_EQ(image_error(image, image).mse, 0.0);
    EXPECT_EQ(image_error(image, image).relative_mse, 0.0);
}

TEST(ErrorMetrics, SmallCase) {
    // Differences 1, -2, 0, of which the squares are 1, 4, 0; divisors 4.01, 0.01, 1.01.
    const std::array image{3.0F, -2.0F, 1.0F};
    const std::array reference{2.0F, 0.0F, 1.0F};
    const cli::ImageError error = image_error(image, reference);
    EXPECT_DOUBLE_EQ(error.mse, 5.0 / 3.0);
    EXPECT_DOUBLE_EQ(error.relative_mse, (1.0 / 4.01 + 4.0 / 0.01) / 3.0);
}

// A relative error that divided by the image in place of the reference, or not at all, would be symmetric or equal.
TEST(ErrorMetrics, TheReferenceIsTheDivisor) {
    const std::array dark{0.1F};
    const std::array bright{10.0F};
    EXPECT_GT(image_error(bright, dark).relative_mse, 1000.0 * image_error(dark, bright).relative_mse);
    EXPECT_EQ(image_error(bright, dark).mse, image_error(dark, bright).mse);
}

} // namespace
