// The errors of regions and tiles, which are found for many values at once, bit for bit: value by value, by the
// definitions in shaders/pixel_error.h, with sums in the order of the values.
#include "lib/film/region_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace region_errors_bits {

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

// A region of random values, with fireflies, edges and black pixels.
class Region {
public:
    Region(const Size &size, unsigned seed) : size_(size) {
        std::mt19937 random(seed);
        const auto share = [&random] { return static_cast<float>(random() % 1024) / 1024.0F; };
        for (std::size_t i = 0; i < 3 * size.width * size.height; ++i) {
            const unsigned kind = static_cast<unsigned>(random() % 8);
            const float mean = kind == 0 ? 0.0F : kind == 1 ? 1000.0F * share() : 1.0F + share();
            const float lesser = kind == 2 ? 0.0F : mean * share();
            mean_.push_back(mean);
            lesser_.push_back(lesser);
            standard_error_.push_back((mean - lesser) * (kind == 3 ? 0.5F : 1.0F));
        }
        for (std::size_t tile = 0; tile < 16; ++tile)
            sample_counts_.at(tile) = static_cast<double>(16 << tile % 5);
    }

    pt::RegionPixels pixels() const {
        return {{size_.width, size_.height, size_.width, size_.width * size_.height, mean_.data(),
                 standard_error_.data(), lesser_.data()},
                0,
                sample_counts_};
    }

    const Size &size() const { return size_; }

    Value value(std::size_t channel, std::size_t x, std::size_t y) const {
        const std::size_t i = (channel * size_.height + y) * size_.width + x;
        return {static_cast<double>(mean_[i]), static_cast<double>(standard_error_[i]),
                static_cast<double>(lesser_[i])};
    }

    double sample_count(std::size_t x, std::size_t y) const {
        return sample_counts_.at(y / 8 * ((size_.width + 7) / 8) + x / 8);
    }

private:
    Size size_;
    std::vector<float> mean_;
    std::vector<float> standard_error_;
    std::vector<float> lesser_;
    std::array<double, 16> sample_counts_{};
};

// Rectangles of a channel, from the first place to before the last.
struct Part {
    std::size_t left;
    std::size_t top;
    std::size_t right;
    std::size_t bottom;
};

Part tile_about(const Region &region, std::size_t x, std::size_t y) {
    return {x / 8 * 8, y / 8 * 8, std::min(x / 8 * 8 + 8, region.size().width),
            std::min(y / 8 * 8 + 8, region.size().height)};
}

std::vector<double> means_of(const Region &region, std::size_t channel, const Part &part) {
    std::vector<double> means;
    for (std::size_t y = part.top; y < part.bottom; ++y)
        for (std::size_t x = part.left; x < part.right; ++x)
            means.push_back(region.value(channel, x, y).mean);
    return means;
}

// Of those that touch a pixel of a part of the region, and itself, ascending.
std::vector<double> means_about(const Region &region, std::size_t channel, std::size_t x, std::size_t y,
                                const Part &part) {
    std::vector<double> means = means_of(region, channel,
                                         {std::max(x, part.left + 1) - 1, std::max(y, part.top + 1) - 1,
                                          std::min(x + 2, part.right), std::min(y + 2, part.bottom)});
    std::ranges::sort(means);
    return means;
}

double mean_besides(std::vector<double> values, double value, bool without_largest) {
    double sum = 0.0;
    for (const double each : values)
        sum += each;
    sum -= value;
    values.erase(std::ranges::find(values, value));
    auto others = static_cast<double>(values.size());
    if (without_largest) {
        sum -= values.empty() ? 0.0 : *std::ranges::max_element(values);
        others -= 1.0;
    }
    return std::max(sum, 0.0) / std::max(others, 1.0);
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
    const double of_corners = 0.05 * (b * b) / (std::sqrt(samples) * (3.0 + 0.81 * b + 0.9 * b * std::sqrt(b)));
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

// Summed over channels.
struct Errors {
    double square;
    double relative_square;
    double met_once;
    double as_lamps;
    double met_again;
    double unseen;
};

double around(const Region &region, std::size_t channel, std::size_t x, std::size_t y) {
    const Part all{0, 0, region.size().width, region.size().height};
    const double mean = region.value(channel, x, y).mean;
    const std::vector<double> tile = means_of(region, channel, tile_about(region, x, y));
    const double level = mean_besides(tile, mean, true);
    const bool is_of_tile = level >= 0.5 * mean_besides(tile, mean, false);
    const std::vector<double> near = means_about(region, channel, x, y, all);
    return std::max(near.size() == 1 ? 0.0 : near[(near.size() - 1) / 2],
                    is_of_tile ? level : mean_besides(means_of(region, channel, all), mean, true));
}

TEST(ErrorRegionBits, AreThoseOfEachValue) {
    for (const Size &size :
         {Size{32, 32}, Size{27, 13}, Size{1, 1}, Size{9, 1}, Size{1, 20}, Size{2, 2}, Size{32, 3}}) {
        const Region region(size, 3);
        pt::PixelErrors found;
        pt::find_pixel_errors(region.pixels().values, region.pixels().sample_counts, found);
        for (std::size_t y = 0; y < size.height; ++y)
            for (std::size_t x = 0; x < size.width; ++x) {
                const Part all{0, 0, size.width, size.height};
                Errors expected{};
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    const Value value = region.value(channel, x, y);
                    expected.square += value.standard_error * value.standard_error;
                    const double level = around(region, channel, x, y);
                    const bool once = is_met_once(value, level);
                    (once ? expected.met_once : expected.relative_square) += relative_square(value, level);
                    expected.as_lamps += once ? as_lamp(value) : 0.0;
                    expected.met_again +=
                        !once && stands_out(value, level) && value.lesser >= 0.25 * value.mean ? 1.0 : 0.0;
                    expected.unseen +=
                        unseen(value.mean, means_about(region, channel, x, y, all).back(), region.sample_count(x, y));
                }
                const std::size_t pixel = y * pt::region_size + x;
                EXPECT_EQ(found.square[pixel], expected.square) << x << " " << y;
                EXPECT_EQ(found.relative_square[pixel], expected.relative_square) << x << " " << y;
                EXPECT_EQ(found.met_once[pixel], expected.met_once) << x << " " << y;
                EXPECT_EQ(found.as_lamps[pixel], expected.as_lamps) << x << " " << y;
                EXPECT_EQ(found.met_again[pixel], expected.met_again) << x << " " << y;
                EXPECT_EQ(found.unseen[pixel], expected.unseen) << x << " " << y;
            }
    }
}

TEST(ErrorRegionBits, OfTilesAreSumsOfEachValue) {
    for (const Size &size : {Size{8, 8}, Size{5, 8}, Size{8, 1}, Size{1, 1}}) {
        const Region tile(size, 4);
        const Part all{0, 0, size.width, size.height};
        double expected = 0.0;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            double sum = 0.0;
            for (std::size_t y = 0; y < size.height; ++y)
                for (std::size_t x = 0; x < size.width; ++x) {
                    const Value value = tile.value(channel, x, y);
                    const double level = mean_besides(means_of(tile, channel, all), value.mean, true);
                    sum += (is_met_once(value, level) ? as_lamp(value) : relative_square(value, level)) +
                           unseen(value.mean, means_about(tile, channel, x, y, all).back(), tile.sample_count(0, 0));
                }
            expected += sum;
        }
        EXPECT_EQ(pt::own_square_of(tile.pixels()), expected) << size.width << " x " << size.height;
    }
}

} // namespace

} // namespace region_errors_bits
