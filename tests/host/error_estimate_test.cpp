// Arithmetic of the error estimate on small images whose result is known.
#include "lib/film/error_estimate.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace {

pt::ErrorEstimate estimate(std::uint32_t width, const std::vector<float> &radiance,
                           const std::vector<float> &standard_error, double exaggeration = 1.0) {
    pt::ErrorEstimator estimator(width);
    estimator.add(radiance, standard_error);
    return estimator.result(exaggeration);
}

// 3^2 + 4^2 over 6 values; relative to 10^2 + 0.01 and to 0.01.
TEST(ErrorEstimate, IsTheRootOfTheMeanOfSquares) {
    const pt::ErrorEstimate found = estimate(2, {10, 10, 10, 10, 10, 10}, {3, 0, 0, 4, 0, 0});
    EXPECT_DOUBLE_EQ(found.rmse.estimate, std::sqrt(25.0 / 6.0));
    EXPECT_DOUBLE_EQ(found.relative_rmse.estimate, std::sqrt(25.0 / 6.0 / 100.01));
    const pt::ErrorEstimate dark = estimate(2, std::vector<float>(6), {0.5F, 0, 0, 0, 0, 0});
    EXPECT_DOUBLE_EQ(dark.relative_rmse.estimate, std::sqrt(0.25 / 6.0 / 0.01));
}

TEST(ErrorEstimate, OfAnImageWithoutDifferencesIsZero) {
    const pt::ErrorEstimate found = estimate(1, {1, 2, 3}, {0, 0, 0});
    EXPECT_EQ(found.relative_rmse.estimate, 0.0);
    EXPECT_EQ(found.relative_rmse.low, 0.0);
    EXPECT_EQ(found.relative_rmse.high, 0.0);
}

TEST(ErrorEstimate, OfAnImageWithAnUnknownPixelIsUnknown) {
    const float infinity = std::numeric_limits<float>::infinity();
    const pt::ErrorEstimate found = estimate(2, {1, 1, 1, 0, 0, 0}, {0.5F, 0, 0, infinity, infinity, infinity});
    for (const pt::Interval &interval : {found.rmse, found.relative_rmse}) {
        EXPECT_EQ(interval.estimate, infinity);
        EXPECT_EQ(interval.low, 0.0);
        EXPECT_EQ(interval.high, infinity);
    }
}

TEST(ErrorEstimate, IsHiddenByMoreThanOneLeftOutSampleInAMillion) {
    EXPECT_FALSE(pt::hides_error(0, 16));
    EXPECT_TRUE(pt::hides_error(1, 1 << 19));
    EXPECT_FALSE(pt::hides_error(1, 1 << 20));
    EXPECT_FALSE(pt::hides_error(1 << 10, std::uint64_t{1} << 30));
    EXPECT_TRUE(pt::hides_error((1 << 10) + 1, std::uint64_t{1} << 30));
}

// Two tiles of 8 x 8 pixels with the squares 64 * 3 * 1 and 64 * 3 * 4: their mean is 2.5 a value; their deviations
// from it are 64 * 3 * 1.5, whose root sum of squares is 1.5 sqrt(2) / 5 of the sum.
TEST(ErrorEstimate, BoundsComeFromTheSpreadOverTiles) {
    std::vector<float> errors;
    for (int pixel = 0; pixel < 8 * 16; ++pixel)
        errors.insert(errors.end(), 3, pixel % 16 < 8 ? 1.0F : 2.0F);
    const std::vector<float> radiance(errors.size(), 1.0F);
    const pt::Interval found = estimate(16, radiance, errors).rmse;
    const double spread = std::sqrt(1.0 + 1.96 * 1.5 * std::sqrt(2.0) / 5.0);
    EXPECT_DOUBLE_EQ(found.estimate, std::sqrt(2.5));
    EXPECT_DOUBLE_EQ(found.high, std::sqrt(2.5) * spread);
    EXPECT_DOUBLE_EQ(found.low, std::sqrt(2.5) / spread);
    const pt::Interval adjusted = estimate(16, radiance, errors, 2.0).rmse;
    EXPECT_EQ(adjusted.estimate, found.estimate);
    EXPECT_EQ(adjusted.high, found.high);
    EXPECT_DOUBLE_EQ(adjusted.low, found.low / 2.0);
}

// However the pixels are cut into pieces; with tiles cut off at the right and at the bottom.
TEST(ErrorEstimate, DoesNotDependOnThePieces) {
    constexpr std::uint32_t width = 19;
    constexpr std::uint32_t height = 21;
    std::vector<float> radiance;
    std::vector<float> errors;
    for (std::uint32_t i = 0; i < 3 * width * height; ++i) {
        radiance.push_back(static_cast<float>(i * 7919 % 101) * 0.1F);
        errors.push_back(static_cast<float>(i * 104729 % 97) * 0.01F);
    }
    const pt::ErrorEstimate whole = estimate(width, radiance, errors);
    pt::ErrorEstimator estimator(width);
    for (std::size_t first = 0; first < radiance.size(); first += 3 * 50) {
        const std::size_t count = std::min<std::size_t>(3 * 50, radiance.size() - first);
        estimator.add(std::span(radiance).subspan(first, count), std::span(errors).subspan(first, count));
    }
    const pt::ErrorEstimate pieces = estimator.result(1.0);
    EXPECT_EQ(pieces.rmse.estimate, whole.rmse.estimate);
    EXPECT_EQ(pieces.relative_rmse.estimate, whole.relative_rmse.estimate);
    EXPECT_EQ(pieces.relative_rmse.high, whole.relative_rmse.high);
    EXPECT_GT(whole.relative_rmse.high, whole.relative_rmse.estimate);
}

TEST(SquaredLimit, IsThatOfThePixelWhereItsHalvesAgree) {
    EXPECT_EQ(pt::squared_limit(3.0, 0.0, 3.0), 9.0);
    EXPECT_EQ(pt::squared_limit(3.0, 0.0, 0.0), 9.0); // a bright spot on a dark ground
    EXPECT_EQ(pt::squared_limit(3.0, 0.0, 9.0), 9.0); // a dark spot on a bright ground
}

TEST(SquaredLimit, LeavesOutTheVarianceAndAHalf) {
    EXPECT_EQ(pt::squared_limit(8.0, 4.0, 0.5), 40.0);
}

TEST(SquaredLimit, OfAFireflyIsThatOfItsNeighbours) {
    EXPECT_EQ(pt::squared_limit(8.0, 7.5, 4.0), 16.0);
    EXPECT_EQ(pt::squared_limit(8.0, 8.0, 0.5), 4.0);  // but not below a quarter of its mean
    EXPECT_EQ(pt::squared_limit(8.0, 24.0, 0.5), 4.0); // of few samples among many
}

TEST(Exaggeration, IsThatOfNetsForSequencesOnly) {
    EXPECT_EQ(pt::exaggeration(PT_SAMPLER_RANDOM), 1.0);
    for (const std::uint32_t sampler : {PT_SAMPLER_HALTON, PT_SAMPLER_HALTON_CP, PT_SAMPLER_SOBOL})
        EXPECT_EQ(pt::exaggeration(sampler), std::sqrt(3.0));
}

TEST(Checks, AreAtEighthsOfPowersOfTwo) {
    std::vector<std::uint64_t> checks;
    for (std::uint64_t count = pt::next_check(0); count <= 80; count = pt::next_check(count))
        checks.push_back(count);
    EXPECT_EQ(checks,
              (std::vector<std::uint64_t>{16, 18, 20, 22, 24, 26, 28, 30, 32, 36, 40, 44, 48, 52, 56, 60, 64, 72, 80}));
    for (std::uint32_t count = 0; count <= 80; ++count)
        EXPECT_EQ(pt::is_check(count), std::ranges::find(checks, count) != checks.end()) << count;
    EXPECT_EQ(pt::next_check(15), 16U);
    EXPECT_EQ(pt::next_check(65), 72U);
    EXPECT_EQ(pt::next_check(0xefffffffU), 0xf0000000U);
    EXPECT_EQ(pt::next_check(0xf0000000U), 0x100000000U);
}

} // namespace
