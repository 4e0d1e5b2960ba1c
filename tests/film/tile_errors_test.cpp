// Compares with shaders/pixel_error.h, bit for bit.
#include "lib/film/tile_errors.h"
#include "shaders/pixel_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <random>
#include <vector>

namespace tile_errors {

namespace {

struct Size {
    std::size_t width;
    std::size_t height;
};

struct Value {
    double mean;
    double standard_error;
    double lesser;
};

class Tile {
public:
    Tile(const Size &size, unsigned seed) : values_{.width = size.width, .height = size.height, .sample_count = 64.0} {
        std::mt19937 random(seed);
        const auto share = [&random] { return static_cast<float>(random() % 1024) / 1024.0F; };
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t y = 0; y < size.height; ++y)
                for (std::size_t x = 0; x < size.width; ++x) {
                    const unsigned kind = static_cast<unsigned>(random() % 8);
                    const float mean = kind == 0 ? 0.0F : kind == 1 ? 1000.0F * share() : 1.0F + share();
                    const float lesser = kind == 2 ? 0.0F : mean * share();
                    values_.pixels[y * 8 + x][channel] = {mean, (mean - lesser) * (kind == 3 ? 0.5F : 1.0F), lesser};
                }
    }

    const pt::TileValues &values() const { return values_; }

    Value value(std::size_t channel, std::size_t x, std::size_t y) const {
        const auto [mean, standard_error, lesser] = values_.pixels[y * 8 + x][channel];
        return {static_cast<double>(mean), static_cast<double>(standard_error), static_cast<double>(lesser)};
    }

    std::vector<double> means(std::size_t channel, std::size_t left, std::size_t top, std::size_t right,
                              std::size_t bottom) const {
        std::vector<double> means;
        for (std::size_t y = top; y < std::min(bottom, values_.height); ++y)
            for (std::size_t x = left; x < std::min(right, values_.width); ++x)
                means.push_back(value(channel, x, y).mean);
        return means;
    }

    std::vector<double> means_about(std::size_t channel, std::size_t x, std::size_t y) const {
        std::vector<double> found =
            means(channel, std::max<std::size_t>(x, 1) - 1, std::max<std::size_t>(y, 1) - 1, x + 2, y + 2);
        std::ranges::sort(found);
        return found;
    }

private:
    pt::TileValues values_;
};

double mean_besides_and_without_largest(std::vector<double> values, double value) {
    double sum = 0.0;
    for (const double each : values)
        sum += each;
    sum -= value;
    values.erase(std::ranges::find(values, value));
    sum -= values.empty() ? 0.0 : *std::ranges::max_element(values);
    return std::max(sum, 0.0) / std::max(static_cast<double>(values.size()) - 1.0, 1.0);
}

double relative_square(const Value &value, double around) {
    const double mean_square = value.mean * value.mean;
    const double dark = std::max(value.lesser, around);
    const double limit = std::min(mean_square, dark * dark) + 0.01;
    const double known = value.lesser * value.lesser + 0.01;
    const double square = value.standard_error * value.standard_error / limit;
    const bool at_edge = value.standard_error >= 0.99 * (value.mean - value.lesser) && around >= value.mean;
    return at_edge && limit > 7.39 * known ? square * (0.5 * std::log(limit / known)) : square;
}

double unseen(double mean, double largest, double samples) {
    const double brightest = largest / samples;
    const double b = brightest / std::sqrt(mean * mean + 0.01);
    const double of_corners = 0.055 * (b * b) / (std::sqrt(samples) * (3.0 + 0.81 * b + 0.9 * b * std::sqrt(b)));
    return mean >= brightest ? 0.0 : of_corners;
}

bool stands_out(const Value &value, double around) {
    return value.mean * value.mean + 0.01 - 7.39 * (around * around + 0.01) > 0.0;
}

bool is_met_once(const Value &value, double around) {
    return stands_out(value, around) && value.lesser <= 0.02 * value.mean &&
           value.standard_error >= 0.99 * (value.mean - value.lesser);
}

double as_lamp(const Value &value) {
    return value.standard_error * value.standard_error / (value.mean * value.mean + 0.01);
}

struct Errors {
    double square;
    double relative_square;
    double met_once;
    double as_lamps;
    double met_again;
    double unseen;
};

double around(const Tile &tile, std::size_t channel, std::size_t x, std::size_t y) {
    const double mean = tile.value(channel, x, y).mean;
    const std::vector<double> near = tile.means_about(channel, x, y);
    return std::max({near.size() == 1 ? 0.0 : near[(near.size() - 1) / 2], near.back() > mean ? near.back() / 8.0 : 0.0,
                     mean_besides_and_without_largest(tile.means(channel, 0, 0, 8, 8), mean)});
}

Errors expected_errors(const Tile &tile, std::size_t x, std::size_t y) {
    Errors expected{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const Value value = tile.value(channel, x, y);
        const double level = around(tile, channel, x, y);
        const bool once = is_met_once(value, level);
        expected.square += value.standard_error * value.standard_error;
        (once ? expected.met_once : expected.relative_square) += relative_square(value, level);
        expected.as_lamps += once ? as_lamp(value) : 0.0;
        expected.met_again += !once && stands_out(value, level) && value.lesser >= 0.25 * value.mean ? 1.0 : 0.0;
        expected.unseen += unseen(value.mean, tile.means_about(channel, x, y).back(), tile.values().sample_count);
    }
    return expected;
}

constexpr Size sizes[] = {{8, 8}, {7, 5}, {1, 1}, {8, 1}, {1, 6}, {2, 2}, {8, 3}};

TEST(TileErrors, AreSumsOverPixels) {
    for (unsigned seed = 0; seed < 8 * std::size(sizes); ++seed) {
        const Size &size = sizes[seed % std::size(sizes)];
        const Tile tile(size, seed);
        Errors sums{};
        double squares_of_relative = 0.0;
        for (std::size_t y = 0; y < size.height; ++y)
            for (std::size_t x = 0; x < size.width; ++x) {
                const Errors pixel = expected_errors(tile, x, y);
                sums.square += pixel.square;
                sums.relative_square += pixel.relative_square;
                sums.met_once += pixel.met_once;
                sums.as_lamps += pixel.as_lamps;
                sums.met_again += pixel.met_again;
                sums.unseen += pixel.unseen;
                squares_of_relative += pixel.relative_square * pixel.relative_square;
            }
        const pt::TileErrors found = pt::tile_errors(tile.values());
        EXPECT_EQ(found.value_count, static_cast<double>(3 * size.width * size.height));
        EXPECT_EQ(found.square.sum, sums.square);
        EXPECT_EQ(found.relative_square.sum, sums.relative_square);
        EXPECT_EQ(found.relative_square.of_pixels, squares_of_relative);
        EXPECT_EQ(found.met_once.sum, sums.met_once);
        EXPECT_EQ(found.as_lamps.sum, sums.as_lamps);
        EXPECT_EQ(found.met_again, sums.met_again);
        EXPECT_EQ(found.unseen, sums.unseen);
        EXPECT_EQ(found.own_square(), sums.relative_square + sums.as_lamps + sums.unseen);
    }
}

// The expected value is the integral of 0.055 / (2 sqrt(p)) p / N / (a^2 + p^2) over p from 0 to 1 / N. The loop takes
// steps of s = sqrt(p).
TEST(TileErrors, UnseenLightIsTheExpectationOverCorners) {
    constexpr double samples = 64.0;
    for (const double b : {1.01, 2.0, 10.0, 100.0, 1e4, 1e6}) {
        const double a = 1.0 / (samples * b);
        constexpr int steps = 1'000'000;
        const double step = std::sqrt(1.0 / samples) / steps;
        double integral = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double p = (i + 0.5) * step * (i + 0.5) * step;
            integral += 0.055 * step * p / samples / (a * a + p * p);
        }
        const double found = pt::gpu::unseen_square(0.0, b * samples, samples, 1.0);
        EXPECT_LT(found, 1.006 * integral) << b;
        EXPECT_GT(found, 0.857 * integral) << b;
    }
}

} // namespace

} // namespace tile_errors
