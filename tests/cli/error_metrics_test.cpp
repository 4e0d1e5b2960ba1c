// Tests of cli/error_metrics on cases that can be worked out by hand.
#include "cli/image/error_metrics.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace {

using cli::image_error;
using cli::noise_of_halves;

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

// Whatever the share, the estimate is the variance of the mean of all samples: 1 / count for samples of variance 1.
TEST(ErrorMetrics, NoiseOfTheReference) {
    constexpr std::uint32_t count = 8;
    constexpr std::size_t values = 20000;
    for (const std::uint32_t first_count : {2U, 4U, 7U}) {
        std::mt19937 generator(first_count);
        std::normal_distribution<float> normal;
        std::vector<float> first(values);
        std::vector<float> whole(values);
        for (std::size_t i = 0; i < values; ++i) {
            for (std::uint32_t sample = 0; sample < count; ++sample) {
                const float value = normal(generator);
                first[i] += sample < first_count ? value / static_cast<float>(first_count) : 0.0F;
                whole[i] += value / count;
            }
        }
        // A mean of 20000 squares of normal numbers has the relative standard deviation sqrt(2 / 20000) = 0.01.
        EXPECT_NEAR(noise_of_halves(first, first_count, whole, count).mse * count, 1.0, 0.05) << first_count;
        EXPECT_GT(std::abs(image_error(first, whole).mse * count - 1.0), first_count == 4 ? -1.0 : 0.5); // unscaled
    }
}

TEST(ErrorMetrics, SlopesAndEfficiency) {
    EXPECT_DOUBLE_EQ(cli::convergence_slope(1.0, 16, 0.25, 64).value(), -1.0);
    EXPECT_DOUBLE_EQ(cli::convergence_slope(1.0, 16, 1.0, 64).value(), 0.0);
    EXPECT_EQ(cli::convergence_slope(0.0, 16, 1.0, 64), std::nullopt);
    EXPECT_EQ(cli::convergence_slope(1.0, 16, 0.5, 16), std::nullopt);
    EXPECT_EQ(cli::convergence_slope(1.0, 16, 0.0, 64), std::nullopt);
    EXPECT_DOUBLE_EQ(cli::efficiency(0.5, 4.0).value(), 0.5);
    EXPECT_EQ(cli::efficiency(0.0, 4.0), std::nullopt);
}

TEST(ErrorMetrics, Median) {
    EXPECT_EQ(cli::median(std::array{7.0}), 7.0);
    EXPECT_EQ(cli::median(std::array{100.0, 1.0, 2.0}), 2.0);
    EXPECT_EQ(cli::median(std::array{4.0, 100.0, 1.0, 2.0}), 3.0);
}

} // namespace
