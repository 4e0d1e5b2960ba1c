// A tile of variance v with n samples has the squared error v / n.
#include "lib/film/adaptive_rule.h"
#include "lib/film/error_estimate.h"
#include "lib/film/tile_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace {

using pt::AdaptivePlan;
using pt::AdaptiveRound;
using pt::TileGrid;
using pt::TileSamples;
using pt::TileStep;

constexpr TileGrid model_grid{320, 160}; // 800 whole tiles
constexpr double pixels_of_tile = 64.0;

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

const std::vector<std::uint64_t> no_lamps(model_grid.count());

TileSamples first_samples() {
    return TileSamples(model_grid, pt::SampleSet({0, 16}));
}

struct Sampled {
    TileSamples samples;
    AdaptiveRound round;
    int looks = 0;
};

Sampled sampled_until(const std::vector<double> &variances, double target) {
    Sampled film{first_samples(), {}, 0};
    for (;;) {
        const std::vector<double> squares = model_squares(film.samples, variances);
        const std::vector<double> gains = pt::tile_gains(film.samples, squares);
        ++film.looks;
        const std::vector<std::uint32_t> wanting = pt::wanting_tiles(film.samples, gains, no_lamps, film.round);
        if (wanting.empty()) {
            const double ratio = model_error(film.samples, variances) / target;
            if (ratio <= 1.0)
                return film;
            film.round = pt::round_after(film.round, film.samples, squares, gains, ratio * ratio, false);
            EXPECT_FALSE(pt::wanting_tiles(film.samples, gains, no_lamps, film.round).empty());
            continue;
        }
        for (const std::uint32_t tile : wanting)
            double_samples(film.samples, tile);
    }
}

TEST(AdaptiveRule, LevelsDouble) {
    for (const auto &[count, level] : {std::pair{0U, 16U}, {15U, 16U}, {16U, 32U}, {32U, 64U}, {100U, 128U}})
        EXPECT_EQ(pt::next_level(count), level) << count;
}

// With samples in proportion to sqrt(v), the total is (mean of sqrt(v))^2 / mean(v) times the total with equal samples.
// Counts are powers of two, which costs 4%. The last round may take sqrt(2) times the needed samples. Negative control:
// equal errors in all tiles gain nothing.
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

// The samples of a black tile may have missed all of its light.
TEST(AdaptiveRule, BlackTilesGetHalfOfTheMean) {
    std::vector<double> variances(model_grid.count(), 0.0);
    std::fill_n(variances.begin(), variances.size() / 2, 1.0);
    const Sampled film = sampled_until(variances, 0.01);
    const double pixels = 320.0 * 160.0;
    const double mean = static_cast<double>(film.samples.total()) / pixels;
    EXPECT_GE(static_cast<double>(film.samples.least()), mean / 2.0 / 4.0) << "of the mean two levels before";
    EXPECT_GT(film.samples.least(), 16U);
}

TEST(AdaptiveRule, WhatIsUnknownIsSampledEvenly) {
    const TileSamples samples = first_samples();
    for (const double square : {0.0, static_cast<double>(INFINITY)}) {
        const std::vector<double> squares(model_grid.count(), square);
        const std::vector<double> gains = pt::tile_gains(samples, squares);
        const AdaptiveRound next = pt::round_after({}, samples, squares, gains, INFINITY, false);
        EXPECT_EQ(pt::wanting_tiles(samples, gains, no_lamps, next).size(), model_grid.count());
    }
}

TEST(AdaptiveRule, WhereLightIsUnseenTheFloorRises) {
    TileSamples samples = first_samples();
    for (std::uint32_t tile = 3; tile < model_grid.count(); ++tile)
        double_samples(samples, tile);
    std::vector<double> squares(model_grid.count(), 0.0);
    squares[700] = 1e-3;
    const std::vector<double> gains = pt::tile_gains(samples, squares);
    const AdaptiveRound before = pt::round_after({}, samples, squares, gains, 1.1, false);
    EXPECT_EQ(pt::wanting_tiles(samples, gains, no_lamps, before), std::vector<std::uint32_t>{700});
    for (const double excess : {0.9, 1.1}) {
        const AdaptiveRound next = pt::round_after(before, samples, squares, gains, excess, true);
        EXPECT_EQ(next.number > before.number, excess > 1.0) << "only unseen light is above the target";
        EXPECT_EQ(next.floor, 2 * samples.least());
        EXPECT_EQ(pt::wanting_tiles(samples, gains, no_lamps, next), (std::vector<std::uint32_t>{0, 1, 2, 700}));
    }
}

// If half of the tiles have r times the gain of the others, then mean(v) / mean(sqrt(v))^2 = 2 (1 + r) / (1 +
// sqrt(r))^2.
TEST(AdaptiveRule, TilesThatAreAlikeStayTogether) {
    std::vector<double> gains(1000, 1.0);
    EXPECT_FALSE(pt::are_worth_telling_apart(gains));
    EXPECT_FALSE(pt::are_worth_telling_apart(std::vector<double>(1000, 0.0)));
    for (const auto &[ratio, expected] : {std::pair{6.8, false}, {6.9, true}}) {
        std::fill_n(gains.begin(), 500, ratio);
        EXPECT_EQ(pt::are_worth_telling_apart(gains), expected) << ratio;
    }
}

constexpr TileGrid plan_grid{64, 32}; // 32 whole tiles
constexpr double goal_error = 0.02;
const pt::Stopping until_goal{{goal_error, 0.0}};

bool hold_the_same(const pt::TileSamples &a, const pt::TileSamples &b) {
    for (std::size_t tile = 0; tile < a.grid().count(); ++tile)
        if (a.of(tile) != b.of(tile))
            return false;
    return a.grid() == b.grid();
}

struct ModelFilm {
    TileSamples samples{plan_grid};
    AdaptiveRound round;
    bool has_target_error = false;
};

// After n samples a tile of variance v has the squared error v / n, times a random factor that differs for each n.
// `spread` is the standard deviation of log(v).
class ModelErrors {
public:
    ModelErrors(std::uint32_t seed, double spread) : seed_(seed) {
        std::mt19937 generator(seed);
        std::normal_distribution<double> exponent(0.0, spread);
        for (std::size_t tile = 0; tile < plan_grid.count(); ++tile)
            variances_.push_back(std::exp(exponent(generator)));
    }

    std::vector<double> squares_of(const ModelFilm &film) const {
        std::vector<double> squares;
        for (std::uint32_t tile = 0; tile < plan_grid.count(); ++tile) {
            const auto count = static_cast<std::uint32_t>(film.samples.of(tile).count());
            std::mt19937 generator(seed_ ^ (tile << 20U) ^ count);
            const double factor = std::uniform_real_distribution<double>(0.2, 1.8)(generator);
            squares.push_back(count < 16 ? HUGE_VAL : pixels_of_tile * variances_[tile] / count * factor);
        }
        return squares;
    }

    std::vector<std::uint64_t> samples_for_lamps() const {
        std::vector<std::uint64_t> needed(plan_grid.count());
        for (std::size_t tile = seed_ % 5; tile < needed.size(); tile += 11)
            needed[tile] = std::uint64_t{100} << 2 * seed_;
        return needed;
    }

    pt::ErrorEstimate error_of(const ModelFilm &film) const {
        const std::vector<double> squares = squares_of(film);
        const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
        const double error = std::sqrt(sum / (pixels_of_tile * static_cast<double>(plan_grid.count())));
        return {.rmse = {}, .relative_rmse = {error, error, error}, .uncertain = 0};
    }

private:
    std::uint32_t seed_;
    std::vector<double> variances_;
};

void sample_plan(ModelFilm &film, const ModelErrors &errors, const pt::MostSamples &counts, std::uint64_t stop_after) {
    const AdaptivePlan plan(until_goal, counts,
                            {[&] { return errors.error_of(film); }, [&] { return errors.squares_of(film); },
                             [&] { return errors.samples_for_lamps(); }});
    for (;;) {
        const std::optional<TileStep> step = plan.next(film.samples, film.round);
        film.has_target_error = !step;
        if (!step || step->tiles.empty())
            return;
        const TileSamples before = film.samples;
        std::vector<std::uint64_t> goals;
        for (const std::uint32_t tile : step->tiles)
            goals.push_back(step->goal(tile));
        for (std::size_t i = 0; i < goals.size(); ++i) {
            const std::uint64_t count = before.of(step->tiles[i]).count();
            ASSERT_GT(goals[i], count);
            ASSERT_LE(goals[i], counts.most);
            const bool is_last = stop_after-- == 0;
            const std::uint64_t end = is_last ? (count + goals[i]) / 2 : goals[i];
            if (end > count)
                film.samples.add(std::vector{step->tiles[i]}, {count, end});
            if (is_last)
                return;
        }
        film.samples.tidy();
    }
}

ModelFilm sampled_in_calls(const ModelErrors &errors, std::uint64_t most, std::mt19937 &generator) {
    ModelFilm film;
    for (int call = 0; call < 12; ++call) {
        const std::uint64_t more = generator() % 4 == 0 ? 0 : generator() % 200;
        const bool stops = generator() % 2 == 0;
        sample_plan(film, errors, {std::min(film.samples.most() + more, most), most},
                    stops ? generator() % 40 : UINT64_MAX);
    }
    sample_plan(film, errors, {most, most}, UINT64_MAX);
    return film;
}

TEST(AdaptivePlan, CallsThatEndAnywhereComeToTheSameSamples) {
    std::mt19937 generator(1);
    int with_target_error = 0;
    int apart = 0;
    for (const double spread : {0.1, 0.7, 1.6})
        for (const std::uint64_t most : {100U, 512U, 3000U, 1U << 30U})
            for (std::uint32_t seed = 0; seed < 5; ++seed) {
                const ModelErrors errors(seed, spread);
                ModelFilm expected;
                sample_plan(expected, errors, {most, most}, UINT64_MAX);
                const bool on_target = errors.error_of(expected).relative_rmse.high <= goal_error;
                with_target_error += expected.has_target_error ? 1 : 0;
                apart += expected.samples.even() ? 0 : 1;
                for (int i = 0; i < 4; ++i) {
                    const ModelFilm found = sampled_in_calls(errors, most, generator);
                    ASSERT_TRUE(hold_the_same(found.samples, expected.samples)) << spread << ' ' << most << ' ' << seed;
                    ASSERT_EQ(found.has_target_error, expected.has_target_error);
                    ASSERT_EQ(found.round, expected.round);
                }
                for (std::size_t tile = 0; tile < plan_grid.count(); ++tile) {
                    const std::uint64_t enough = expected.has_target_error ? errors.samples_for_lamps()[tile]
                                                 : on_target               ? 0
                                                                           : most;
                    ASSERT_GE(expected.samples.of(tile).count(), enough);
                }
            }
    EXPECT_GT(with_target_error, 10);
    EXPECT_LT(with_target_error, 50);
    EXPECT_GT(apart, 8);
}

} // namespace
