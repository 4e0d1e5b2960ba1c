#include "lib/film/error_estimate.h"
#include "lib/film/tile_grid.h"

#include <gtest/gtest.h>
#include <pt/stats.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

constexpr double sample_count = 0x1p40;

void add_tiles(pt::ErrorEstimator &estimator, std::uint32_t width, const std::vector<float> &radiance,
               const std::vector<float> &errors, double samples) {
    const pt::TileGrid grid{width, static_cast<std::uint32_t>(radiance.size() / 3 / width)};
    for (std::size_t i = 0; i < grid.count(); ++i) {
        const pt::Rectangle pixels = grid.pixels(i);
        pt::TileValues tile{.width = pixels.width, .height = pixels.height, .sample_count = samples};
        for (std::size_t y = 0; y < tile.height; ++y)
            for (std::size_t value = 0; value < 3 * tile.width; ++value) {
                const std::size_t from = 3 * ((pixels.y + y) * width + pixels.x) + value;
                tile.pixels[y * pt::tile_size + value / 3][value % 3] = {
                    radiance[from], errors[from], std::isfinite(errors[from]) ? radiance[from] - errors[from] : 0.0F};
            }
        estimator.add(tile_errors(tile));
    }
}

pt::ErrorEstimate estimate(std::uint32_t width, const std::vector<float> &radiance,
                           const std::vector<float> &standard_error, std::uint32_t sampler = PT_SAMPLER_RANDOM,
                           bool may_miss_lamps = false) {
    pt::ErrorEstimator estimator({sampler, may_miss_lamps});
    add_tiles(estimator, width, radiance, standard_error, sample_count);
    return estimator.result();
}

// The margin for squares concentrated in `pixel_count` equal pixels (error_estimate.cpp).
double raised(double root, double pixel_count) {
    return root * (1.0 + 0.6 / std::sqrt(pixel_count) + 2.5 / pixel_count);
}

// Two of six values have the squares 3^2 and 4^2. The squares are as concentrated as 25^2 / (9^2 + 16^2) equal values.
TEST(ErrorEstimate, IsTheRootOfTheMeanOfSquares) {
    const pt::ErrorEstimate found = estimate(2, {10, 10, 10, 10, 10, 10}, {3, 0, 0, 4, 0, 0});
    const double pixel_count = 625.0 / 337.0;
    EXPECT_DOUBLE_EQ(found.rmse.estimate, raised(std::sqrt(25.0 / 6.0), pixel_count));
    EXPECT_DOUBLE_EQ(found.relative_rmse.estimate, raised(std::sqrt(25.0 / 6.0 / 100.01), pixel_count));
}

TEST(ErrorEstimate, IsUncertainIfItComesFromFewPixels) {
    std::vector<float> errors(3 * 32 * 32, 0.0F);
    const std::vector<float> radiance(errors.size(), 1.0F);
    for (std::size_t pixel = 0; pixel < 3; ++pixel)
        errors[3 * 50 * pixel] = 0.1F;
    const pt::ErrorEstimate few = estimate(32, radiance, errors);
    EXPECT_EQ(few.uncertain, unsigned{PT_UNCERTAIN_RMSE} | unsigned{PT_UNCERTAIN_RELATIVE_RMSE});
    errors[3 * 50 * 3] = errors[3 * 50 * 4] = 0.1F;
    EXPECT_EQ(estimate(32, radiance, errors).uncertain, 0U);
}

TEST(ErrorEstimate, IsUncertainWhereLampsMayBeMissed) {
    const std::vector<float> errors(3 * 32 * 32, 0.1F);
    const std::vector<float> radiance(errors.size(), 1.0F);
    const pt::ErrorEstimate met = estimate(32, radiance, errors);
    const pt::ErrorEstimate missed = estimate(32, radiance, errors, PT_SAMPLER_RANDOM, true);
    EXPECT_EQ(met.uncertain, 0U);
    EXPECT_EQ(missed.uncertain, unsigned{PT_UNCERTAIN_UNMET});
    EXPECT_EQ(missed.rmse.estimate, met.rmse.estimate);
    EXPECT_DOUBLE_EQ(missed.rmse.high, 2.0 * met.rmse.high);
    EXPECT_DOUBLE_EQ(missed.relative_rmse.low, 0.5 * met.relative_rmse.low);
    const std::vector<float> black(errors.size(), 0.0F);
    EXPECT_EQ(estimate(32, black, black).relative_rmse.high, 0.0);
    EXPECT_TRUE(std::isinf(estimate(32, black, black, PT_SAMPLER_RANDOM, true).relative_rmse.high));
}

// Bright pixels, one in each tile, of which `met_once` were hit by one part of the samples.
pt::ErrorEstimate estimate_of_lamps(std::size_t met_once, std::size_t met_again) {
    std::vector<float> radiance(3 * 64 * 64, 0.0F);
    std::vector<float> errors(radiance.size(), 0.0F);
    for (std::size_t i = 0; i < met_once + met_again; ++i) {
        const std::size_t pixel = i % 8 * 8 + 4 + (i / 8 * 8 + 4) * 64;
        std::fill_n(&radiance[3 * pixel], 3, 100.0F);
        std::fill_n(&errors[3 * pixel], 3, i < met_once ? 100.0F : 0.0F);
    }
    return estimate(64, radiance, errors);
}

// If most bright pixels were hit once, their errors are relative to the black around them. Otherwise they are relative
// to the expected number of hits, 2 ln 3.
TEST(ErrorEstimate, TellsLampsFromRareSamples) {
    const auto relative_square = [](std::uint32_t met_once, std::uint32_t met_again) {
        const double error = estimate_of_lamps(met_once, met_again).relative_rmse.estimate / raised(1.0, met_once);
        return error * error * 64 * 64 / met_once;
    };
    const auto expected = [](double met_once, double met_again) {
        const double meetings = 2.0 * std::log(1.0 + 2.0 * (met_again + 0.5) / (met_once + 1.0));
        return std::max(1.0, 1.0 / (meetings * meetings));
    };
    for (const auto &[once, again] : {std::pair{40U, 0U}, {40U, 4U}, {20U, 20U}, {8U, 50U}, {1U, 0U}})
        EXPECT_NEAR(relative_square(once, again), expected(once, again), 2e-3 * expected(once, again)) << once;
    EXPECT_GT(expected(40, 0), 300.0);
}

// 40 pixels have one hit each, and 0 or 20 other pixels have several hits. If 20 pixels have several hits, at least 20
// - 1.96 sqrt(20) such pixels are expected. If none has, the light may be so rare that errors are relative to the black
// around each pixel.
TEST(ErrorEstimate, IsBoundedByTheRarestLightThatMeetingsAllow) {
    const double least = 20.0 - 1.96 * std::sqrt(20.0);
    const auto square = [](double met_again) {
        return std::max(1.0, std::pow(2.0 * std::log(1.0 + 2.0 * met_again / 41.0), -2.0));
    };
    for (const auto &[again, ratio] : {std::pair{0U, 1e6 / square(0.5)}, {20U, square(least) / square(20.5)}}) {
        const pt::ErrorEstimate found = estimate_of_lamps(40, again);
        const double without = found.rmse.high / found.rmse.estimate;
        const bool is_uncertain = again == 0;
        EXPECT_EQ(found.uncertain, is_uncertain ? unsigned{PT_UNCERTAIN_RELATIVE_RMSE} : 0U);
        EXPECT_NEAR(found.relative_rmse.high / found.relative_rmse.estimate,
                    without * (is_uncertain ? 2.0 : 1.0) * std::sqrt(ratio), 2e-3 * without * std::sqrt(ratio));
    }
}

// If lamps are found by chance, errors of pixels with one hit are relative to the black around them.
TEST(ErrorEstimate, OfLampsFoundByChanceAsksNotWhatWasMetAgain) {
    std::vector<float> radiance(3 * 32 * 32, 0.0F);
    std::vector<float> errors(radiance.size(), 0.0F);
    for (const std::size_t i : {4 + 4 * 32, 12 + 20 * 32, 28 + 12 * 32}) {
        radiance[3 * i] = 100.0F;
        errors[3 * i] = i == 4 + 4 * 32 ? 100.0F : 0.0F;
    }
    for (const bool by_chance : {false, true}) {
        pt::ErrorEstimator estimator({PT_SAMPLER_RANDOM, false, by_chance});
        add_tiles(estimator, 32, radiance, errors, sample_count);
        const double error =
            estimator.result().relative_rmse.estimate * std::sqrt(3.0 * 32.0 * 32.0) / raised(1.0, 1.0);
        EXPECT_NEAR(error, by_chance ? 100.0 / 0.1 : 1.0, 1e-3);
    }
}

// Pixels beside a bright column may have unseen light.
TEST(ErrorEstimate, CountsLightThatMayBeUnseen) {
    std::vector<float> radiance(3 * 32 * 32, 0.0F);
    std::vector<float> errors(radiance.size(), 0.0F);
    for (std::size_t row = 0; row < 32; ++row) {
        std::fill_n(&radiance[3 * (32 * row + 20)], 3, 160.0F);
        std::fill_n(&errors[3 * (32 * row + 20)], 3, 1.0F);
    }
    pt::ErrorEstimator estimator({PT_SAMPLER_RANDOM, false});
    add_tiles(estimator, 32, radiance, errors, 16);
    const pt::ErrorEstimate found = estimator.result();
    const double seen = 1.0 / (159.0 * 159.0 + 0.01);
    constexpr double b = 10.0 / 0.1;
    constexpr double unseen = 0.055 * b * b / (4.0 * (3.0 + 0.81 * b + 0.9 * 1000.0));
    EXPECT_DOUBLE_EQ(found.relative_rmse.estimate, raised(std::sqrt((seen + 2.0 * unseen) / 32.0), 32.0));
    EXPECT_EQ(found.uncertain, unsigned{PT_UNCERTAIN_UNSEEN});
    EXPECT_EQ(estimate(32, radiance, errors).uncertain, 0U);
}

TEST(ErrorEstimate, OfPlainHaltonIsStatedAFifthLarger) {
    const std::vector<float> errors(3 * 32 * 32, 0.1F);
    const std::vector<float> radiance(errors.size(), 1.0F);
    const pt::Interval own = estimate(32, radiance, errors, PT_SAMPLER_HALTON_CP).rmse;
    const pt::Interval common = estimate(32, radiance, errors, PT_SAMPLER_HALTON).rmse;
    EXPECT_DOUBLE_EQ(common.estimate, 1.2 * own.estimate);
    EXPECT_DOUBLE_EQ(common.high, 1.2 * own.high);
}

TEST(ErrorEstimate, IsHiddenByMoreThanOneLeftOutSampleInAMillion) {
    EXPECT_FALSE(pt::hides_error(0, 16));
    EXPECT_TRUE(pt::hides_error(1, 1 << 19));
    EXPECT_FALSE(pt::hides_error(1, 1 << 20));
    EXPECT_FALSE(pt::hides_error(1 << 10, std::uint64_t{1} << 30));
    EXPECT_TRUE(pt::hides_error((1 << 10) + 1, std::uint64_t{1} << 30));
}

// The sums of squares of two tiles are 64 * 3 * 1 and 64 * 3 * 4. The mean is 2.5 per value, so each sum deviates by 64
// * 3 * 1.5. The root of the sum of their squares, relative to the total, is 1.5 sqrt(2) / 5. The squares are as
// concentrated as (64 * 5)^2 / (64 * 17) equal pixels.
TEST(ErrorEstimate, BoundsComeFromTheSpreadOverTiles) {
    std::vector<float> errors;
    for (int pixel = 0; pixel < 8 * 16; ++pixel)
        errors.insert(errors.end(), 3, pixel % 16 < 8 ? 1.0F : 2.0F);
    const std::vector<float> radiance(errors.size(), 4.0F);
    const pt::Interval found = estimate(16, radiance, errors).rmse;
    const double root = raised(std::sqrt(2.5), 64.0 * 25.0 / 17.0);
    const double spread = std::sqrt(1.0 + 1.96 * 1.5 * std::sqrt(2.0) / 5.0);
    EXPECT_DOUBLE_EQ(found.estimate, root);
    EXPECT_DOUBLE_EQ(found.high, root * spread);
    EXPECT_DOUBLE_EQ(found.low, root / spread);
    const pt::Interval of_nets = estimate(16, radiance, errors, PT_SAMPLER_SOBOL).rmse;
    EXPECT_DOUBLE_EQ(of_nets.estimate, 1.145 * found.estimate);
    EXPECT_EQ(of_nets.high, found.high);
    EXPECT_DOUBLE_EQ(of_nets.low, found.low / std::sqrt(7.0));
    const std::vector<float> alike(errors.size(), 1.0F);
    const pt::Interval without_spread = estimate(16, radiance, alike, PT_SAMPLER_SOBOL).rmse;
    EXPECT_EQ(without_spread.estimate, without_spread.high) << "within the bounds";
}

// In 8 of 64 tiles one pixel has an error, so the bound's logarithm is 1.96 / sqrt(3 * 8).
TEST(ErrorEstimate, BoundsOfFewPixelsAreWide) {
    std::vector<float> errors(3 * 64 * 64, 0.0F);
    for (std::size_t row = 0; row < 64; row += 8)
        errors[3 * 64 * row] = 1.0F;
    const pt::Interval found = estimate(64, std::vector<float>(errors.size(), 1.0F), errors).rmse;
    EXPECT_DOUBLE_EQ(found.high, found.estimate * std::exp(1.96 / std::sqrt(24.0)));
}

TEST(Exaggeration, IsThatOfNetsForSequencesOnly) {
    EXPECT_EQ(pt::exaggeration(PT_SAMPLER_RANDOM), 1.0);
    for (const std::uint32_t sampler : {PT_SAMPLER_HALTON, PT_SAMPLER_HALTON_CP, PT_SAMPLER_SOBOL})
        EXPECT_EQ(pt::exaggeration(sampler), std::sqrt(7.0));
}

TEST(Checks, AreAtQuartersOfPowersOfTwo) {
    std::vector<std::uint64_t> checks;
    for (std::uint64_t count = 0; count <= 80; ++count) {
        if (pt::is_check(count))
            checks.push_back(count);
        EXPECT_TRUE(pt::is_check(pt::next_check(count)) && pt::next_check(count) > count) << count;
    }
    EXPECT_EQ(checks, (std::vector<std::uint64_t>{16, 20, 24, 28, 32, 40, 48, 56, 64, 80}));
    EXPECT_EQ(pt::next_check(65), 80U);
    EXPECT_EQ(pt::next_check(0xe0000000U), 0x100000000U);
}

} // namespace
