// Which tiles take more samples, on films whose errors are known: with n samples, a tile of variance v has the squared
// error v / n.
#include "lib/film/adaptive_rule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace {

using pt::AdaptiveRound;
using pt::TileGrid;
using pt::TileSamples;

constexpr TileGrid model_grid{320, 160}; // 800 whole tiles
constexpr double pixels_of_tile = 64.0;

// Variances of a pixel that spread over as many decades as those of pictures do.
std::vector<double> spread_variances(std::uint32_t seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> exponent(0.0, 1.6);
    std::vector<double> variances(model_grid.count());
    std::ranges::generate(variances, [&] { return std::exp(exponent(generator)); });
    return variances;
}

std::vector<double> model_squares(const TileSamples &samples, const std::vector<double> &variances) {
    std::vector<double> squares;
    for (std::size_t tile = 0; tile < variances.size(); ++tile)
        squares.push_back(pixels_of_tile * variances[tile] / static_cast<double>(samples.of(tile).count()));
    return squares;
}

double model_error(const TileSamples &samples, const std::vector<double> &variances) {
    const std::vector<double> squares = model_squares(samples, variances);
    const double pixels = static_cast<double>(squares.size()) * pixels_of_tile;
    return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / pixels);
}

void double_samples(TileSamples &samples, std::uint32_t tile) {
    const std::uint64_t count = samples.of(tile).count();
    samples.add(std::vector{tile}, {count, pt::next_level(count)});
}

TileSamples first_samples() {
    return TileSamples(model_grid, pt::SampleSet({0, 16}));
}

struct Sampled {
    TileSamples samples;
    AdaptiveRound round;
    int looks = 0;
};

// Until the target is reached.
Sampled sampled_until(const std::vector<double> &variances, double target) {
    Sampled film{first_samples(), {}, 0};
    for (;;) {
        const std::vector<double> squares = model_squares(film.samples, variances);
        const std::vector<double> gains = pt::tile_gains(film.samples, squares);
        ++film.looks;
        const std::vector<std::uint32_t> wanting = pt::wanting_tiles(film.samples, gains, film.round);
        if (wanting.empty()) {
            const double ratio = model_error(film.samples, variances) / target;
            if (ratio <= 1.0)
                return film;
            film.round = pt::round_after(film.round, film.samples, squares, gains, ratio * ratio, false);
            EXPECT_FALSE(pt::wanting_tiles(film.samples, gains, film.round).empty());
            continue;
        }
        for (const std::uint32_t tile : wanting)
            double_samples(film.samples, tile);
    }
}

TEST(AdaptiveRule, LevelsDouble) {
    std::vector<std::uint64_t> levels;
    for (std::uint64_t count = 0; levels.size() < 6; count = levels.back())
        levels.push_back(pt::next_level(count));
    EXPECT_EQ(levels, (std::vector<std::uint64_t>{16, 32, 64, 128, 256, 512}));
    EXPECT_EQ(pt::next_level(15), 16U);
    EXPECT_EQ(pt::next_level(100), 128U);
    for (const std::uint64_t count : {0U, 1U, 8U, 15U, 17U, 48U})
        EXPECT_FALSE(pt::is_level(count)) << count;
    EXPECT_TRUE(pt::is_level(16));
    EXPECT_TRUE(pt::is_level(std::uint64_t{1} << 31));
}

TEST(AdaptiveRule, TilesBetweenLevelsAreUnfinished) {
    TileSamples samples = first_samples();
    EXPECT_TRUE(pt::unfinished_tiles(samples).empty());
    samples.add(std::vector<std::uint32_t>{3, 700}, {16, 20});
    EXPECT_EQ(pt::unfinished_tiles(samples), (std::vector<std::uint32_t>{3, 700}));
    EXPECT_EQ(pt::unfinished_tiles(TileSamples(model_grid)).size(), model_grid.count());
}

// Samples in proportion to the root of v take (mean of root v)^2 / (mean of v) of those of an even film; counts that
// are powers of two are off by up to half a level to either side, which costs 4% as a rule, and the last round falls
// short of its end by no more than a factor 2^(1/2). Stopping at equal errors, the usual rule, gains nothing, and is
// told apart.
TEST(AdaptiveRule, GoesWhereSamplesGainMost) {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        const std::vector<double> variances = spread_variances(seed);
        const auto count = static_cast<double>(variances.size());
        const double mean = std::accumulate(variances.begin(), variances.end(), 0.0) / count;
        double mean_root = 0.0;
        for (const double variance : variances)
            mean_root += std::sqrt(variance) / count;
        const double ideal = mean_root * mean_root / mean;
        ASSERT_LT(ideal, 0.6);
        const auto share_of_even = [&](const TileSamples &samples) {
            const double error = model_error(samples, variances);
            const double pixels = count * pixels_of_tile;
            return static_cast<double>(samples.total()) / pixels * error * error / mean;
        };
        const Sampled film = sampled_until(variances, 0.02);
        EXPECT_GT(share_of_even(film.samples), ideal);
        EXPECT_LT(share_of_even(film.samples), 1.1 * ideal);

        TileSamples equal_errors = first_samples();
        for (std::uint32_t tile = 0; tile < variances.size(); ++tile)
            while (variances[tile] / static_cast<double>(equal_errors.of(tile).count()) > 0.02 * 0.02)
                double_samples(equal_errors, tile);
        EXPECT_GT(share_of_even(equal_errors), 0.9);
    }
}

TEST(AdaptiveRule, DoesNotOvershootTheTarget) {
    for (const double target : {0.05, 0.02, 0.01}) {
        const std::vector<double> variances = spread_variances(4);
        const Sampled film = sampled_until(variances, target);
        EXPECT_LE(model_error(film.samples, variances), target);
        EXPECT_GT(model_error(film.samples, variances), 0.75 * target) << target;
        EXPECT_LT(film.looks, 30);
    }
}

// Tiles that show nothing, since no sample met their light, are not left at 16 samples.
TEST(AdaptiveRule, BlackTilesGetHalfOfTheMean) {
    std::vector<double> variances(model_grid.count(), 0.0);
    std::fill_n(variances.begin(), variances.size() / 2, 1.0);
    const Sampled film = sampled_until(variances, 0.01);
    const double pixels = 320.0 * 160.0;
    const double mean = static_cast<double>(film.samples.total()) / pixels;
    EXPECT_GE(static_cast<double>(film.samples.least()), mean / 2.0 / 4.0) << "of the mean two levels before";
    EXPECT_GT(film.samples.least(), 16U);
}

// Without any tile that shows an error, all take more; what is unknown counts as nothing.
TEST(AdaptiveRule, WhatIsUnknownIsSampledEvenly) {
    const TileSamples samples = first_samples();
    for (const double square : {0.0, static_cast<double>(INFINITY)}) {
        const std::vector<double> squares(model_grid.count(), square);
        const std::vector<double> gains = pt::tile_gains(samples, squares);
        const AdaptiveRound next = pt::round_after({}, samples, squares, gains, INFINITY, false);
        EXPECT_EQ(pt::wanting_tiles(samples, gains, next).size(), model_grid.count());
    }
}

// Where light may be unseen, those with the fewest samples take more, whatever they show.
TEST(AdaptiveRule, WhereLightIsUnseenTheFloorRises) {
    TileSamples samples = first_samples();
    const std::vector<std::uint32_t> few{1, 2, 3};
    for (std::uint32_t tile = 0; tile < model_grid.count(); ++tile)
        if (std::ranges::find(few, tile) == few.end())
            double_samples(samples, tile);
    std::vector<double> squares(model_grid.count(), 0.0);
    squares[700] = 1e-3;
    const std::vector<double> gains = pt::tile_gains(samples, squares);
    for (const bool unseen : {false, true}) {
        const AdaptiveRound next = pt::round_after({}, samples, squares, gains, 1.1, unseen);
        const std::vector<std::uint32_t> wanting = pt::wanting_tiles(samples, gains, next);
        EXPECT_EQ(wanting.size(), unseen ? 4U : 1U);
    }
}

// Nor do others take more where all that tiles show is good enough: no bound finds what samples have not met.
TEST(AdaptiveRule, WhatIsUnseenMovesNoBound) {
    const TileSamples samples = first_samples();
    std::vector<double> squares(model_grid.count(), 1e-6);
    squares[700] = 1e-3;
    const std::vector<double> gains = pt::tile_gains(samples, squares);
    const AdaptiveRound before = pt::round_after({}, samples, squares, gains, 1.1, false);
    const AdaptiveRound next = pt::round_after(before, samples, squares, gains, 0.9, true);
    EXPECT_EQ(next.number, before.number);
    EXPECT_EQ(next.floor, 2 * samples.least());
    EXPECT_EQ(pt::wanting_tiles(samples, gains, next).size(), model_grid.count());
    EXPECT_GT(pt::round_after(before, samples, squares, gains, 1.1, true).number, before.number);
}

// mean(v) mean(1) / mean(root v)^2 of two kinds of tiles, half of each: 2 (1 + r) / (1 + root r)^2 for their ratio r.
TEST(AdaptiveRule, TilesThatAreAlikeStayTogether) {
    std::vector<double> gains(1000, 1.0);
    EXPECT_FALSE(pt::are_worth_telling_apart(gains));
    EXPECT_FALSE(pt::are_worth_telling_apart(std::vector<double>(1000, 0.0)));
    for (const auto &[ratio, expected] : {std::pair{6.8, false}, {6.9, true}}) {
        std::fill_n(gains.begin(), 500, ratio);
        EXPECT_EQ(pt::are_worth_telling_apart(gains), expected) << ratio;
    }
}

TEST(AdaptiveRule, OfTwoFilmsTheLaterRoundGoesOn) {
    EXPECT_EQ(pt::later_of({3, 16}, {5, 8}), (AdaptiveRound{5, 16}));
    EXPECT_EQ(pt::later_of({}, {-4, 0}), (AdaptiveRound{-4, 0}));
}

} // namespace
