// A film on its way to a target error, however it is interrupted: on films whose errors are known, without a device.
#include "lib/film/adaptive_plan.h"

#include "lib/film/error_estimate.h"
#include "lib/film/tile_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

namespace {

using pt::AdaptivePlan;
using pt::AdaptiveRound;
using pt::TileSamples;
using pt::TileStep;

constexpr pt::TileGrid plan_grid{64, 32};    // 32 whole tiles
constexpr double pixels_of_plan_tile = 64.0; // of a tile
constexpr double goal_error = 0.02;

struct ModelFilm {
    TileSamples samples{plan_grid};
    AdaptiveRound round;
    std::vector<double> squares;
    bool has_target_error = false;
};

// The square error of a tile: its variance by its samples, but for a factor of its own for each number of samples, as
// the difference of two parts of a film scatters. spread: how far tiles differ, as the logarithm of a factor.
class ModelErrors {
public:
    ModelErrors(std::uint32_t seed, double spread) : seed_(seed) {
        std::mt19937 generator(seed);
        std::normal_distribution<double> exponent(0.0, spread);
        for (std::size_t tile = 0; tile < plan_grid.count(); ++tile)
            variances_.push_back(std::exp(exponent(generator)));
    }

    const std::vector<double> &squares_of(ModelFilm &film) const {
        film.squares.clear();
        for (std::uint32_t tile = 0; tile < plan_grid.count(); ++tile) {
            const auto count = static_cast<std::uint32_t>(film.samples.of(tile).count());
            std::mt19937 generator(seed_ ^ (tile << 20U) ^ count);
            const double factor = std::uniform_real_distribution<double>(0.2, 1.8)(generator);
            film.squares.push_back(count < 16 ? HUGE_VAL : pixels_of_plan_tile * variances_[tile] / count * factor);
        }
        return film.squares;
    }

    AdaptivePlan::Error error_of(ModelFilm &film) const {
        squares_of(film);
        const double sum = std::accumulate(film.squares.begin(), film.squares.end(), 0.0);
        return {std::sqrt(sum / (pixels_of_plan_tile * static_cast<double>(plan_grid.count()))), false};
    }

private:
    std::uint32_t seed_;
    std::vector<double> variances_;
};

// Samples that may be taken until the film has the error, or none may be. stop_after: tiles, of which the last comes
// no further than half of its way; then it ends.
void sample_plan(ModelFilm &film, const ModelErrors &errors, std::uint64_t most, std::uint64_t stop_after) {
    const AdaptivePlan plan(
        goal_error, most, [&] { return errors.error_of(film); }, [&] { return errors.squares_of(film); });
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
            ASSERT_LE(goals[i], most);
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

ModelFilm sampled_at_once(const ModelErrors &errors, std::uint64_t most) {
    ModelFilm film;
    sample_plan(film, errors, most, UINT64_MAX);
    return film;
}

// In calls that end after some tiles, or at some samples, and at last without either. as_few: those that some pixels
// lack of the most that others have, now and then.
ModelFilm sampled_in_calls(const ModelErrors &errors, std::uint64_t most, std::mt19937 &generator) {
    ModelFilm film;
    for (int call = 0; call < 12; ++call) {
        const std::uint64_t more = generator() % 4 == 0 ? 0 : generator() % 200;
        const bool stops = generator() % 2 == 0;
        sample_plan(film, errors, std::min(film.samples.most() + more, most), stops ? generator() % 40 : UINT64_MAX);
    }
    sample_plan(film, errors, most, UINT64_MAX);
    return film;
}

// Tiles that are as different as in pictures, that are alike, and limits at a level, between levels, and beyond the
// target.
TEST(AdaptivePlan, CallsThatEndAnywhereComeToTheSameSamples) {
    std::mt19937 generator(1);
    int with_target_error = 0;
    int apart = 0;
    for (const double spread : {0.1, 0.7, 1.6})
        for (const std::uint64_t most : {100U, 512U, 3000U, 1U << 30U})
            for (std::uint32_t seed = 0; seed < 5; ++seed) {
                const ModelErrors errors(seed, spread);
                const ModelFilm expected = sampled_at_once(errors, most);
                with_target_error += expected.has_target_error ? 1 : 0;
                apart += expected.samples.even() ? 0 : 1;
                for (int i = 0; i < 4; ++i) {
                    const ModelFilm found = sampled_in_calls(errors, most, generator);
                    ASSERT_TRUE(found.samples.equals(expected.samples)) << spread << ' ' << most << ' ' << seed;
                    ASSERT_EQ(found.has_target_error, expected.has_target_error);
                    ASSERT_EQ(found.round, expected.round);
                }
            }
    EXPECT_GT(with_target_error, 10);
    EXPECT_LT(with_target_error, 50);
    EXPECT_GT(apart, 20);
}

// The last tiles of a round lift the image over its target before those that want more in it have it.
TEST(AdaptivePlan, ARoundThatIsUnderWayIsNotTheEnd) {
    ModelFilm film{TileSamples(plan_grid, pt::SampleSet({0, 16})), {20, 0}, {}, false};
    film.samples.add(std::vector<std::uint32_t>{5}, {16, 24});
    film.squares.assign(plan_grid.count(), 0.0);
    const AdaptivePlan plan(
        goal_error, 24,
        [] {
            return AdaptivePlan::Error{goal_error / 2, false};
        },
        [&] { return film.squares; });
    const std::optional<TileStep> step = plan.next(film.samples, film.round);
    ASSERT_TRUE(step.has_value());
    EXPECT_TRUE(step->tiles.empty());
    film.samples.add(std::vector<std::uint32_t>{5}, {24, 32});
    EXPECT_FALSE(plan.next(film.samples, film.round).has_value());
}

} // namespace
