// Estimates the error of an image from the standard errors of its pixels; see error_estimate.h.
#include "lib/film/error_estimate.h"

#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>

namespace pt {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Pixels of a tile's side: large against what neighbours share, small enough for hundreds of tiles in a small image.
constexpr std::size_t tile_size = 8;

// Keeps black pixels from counting without bound.
constexpr double relative_offset = 0.01;

// Of the normal distribution: 95% lie within.
constexpr double normal_95 = 1.96;

// Median of the values of one channel in the pixels of a band that touch a pixel, and its own.
double median_about(const std::vector<float> &band, std::size_t row_values, std::size_t row, std::size_t value) {
    std::array<float, 9> values{};
    std::size_t count = 0;
    const std::size_t rows = band.size() / row_values;
    for (std::size_t y = row - (row > 0 ? 1 : 0); y <= row + 1 && y < rows; ++y)
        for (std::size_t x = value - (value >= 3 ? 3 : 0); x <= value + 3 && x < row_values; x += 3)
            values[count++] = band[y * row_values + x];
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
    return static_cast<double>(*middle);
}

} // namespace

ErrorEstimate unknown_error() {
    return {{infinity, 0.0, infinity}, {infinity, 0.0, infinity}};
}

bool hides_error(std::uint64_t rejected_samples, std::uint64_t samples) {
    return rejected_samples > samples >> 20;
}

std::uint64_t next_check(std::uint64_t sample_count) {
    if (sample_count < min_estimate_samples)
        return min_estimate_samples;
    const std::uint64_t step = std::bit_floor(sample_count) / 8;
    return (sample_count / step + 1) * step;
}

bool is_check(std::uint64_t sample_count) {
    return sample_count >= min_estimate_samples && next_check(sample_count - 1) == sample_count;
}

double exaggeration(std::uint32_t sampler) {
    // If the mean square error falls as N^-p, the expectation of a quarter of the squared difference of the two runs
    // of N / 2 points that make up one of N is 2^p - 1 of it: exact for p = 1, the slowest that is usual, and too
    // much by 3 for p = 2.
    return sampler == PT_SAMPLER_RANDOM ? 1.0 : std::sqrt(3.0);
}

double squared_limit(double mean, double standard_error, double median) {
    // The square of the mean exceeds that of the limit by the variance, on average, and the square of the standard
    // error is what estimates the variance, so their difference has the right expectation. (For equal parts it is the
    // product of their means.) It keeps a pixel with a rare bright sample, a firefly, from hiding its error by it.
    // Half as much again is taken off: the limit and the error correlate positively, so that dividing by the unbiased
    // limit would bias the ratio low; 1.5 was calibrated. Where the difference happens to be small, the neighbours give
    // a better limit, and a fraction of the mean bounds what a pixel counts that a single sample lit.
    const double least = 0.25 * mean;
    const double limit =
        std::max({mean * mean - 1.5 * standard_error * standard_error, median * median, least * least});
    return std::min(mean * mean, limit);
}

ErrorEstimator::ErrorEstimator(std::uint32_t width) : row_values_(std::size_t{3} * width) {}

void ErrorEstimator::add(std::span<const float> radiance, std::span<const float> standard_error) {
    const std::size_t band_values = row_values_ * tile_size;
    while (!radiance.empty()) {
        const std::size_t taken = std::min(band_values - radiance_.size(), radiance.size());
        std::ranges::copy(radiance.first(taken), std::back_inserter(radiance_));
        std::ranges::copy(standard_error.first(taken), std::back_inserter(standard_error_));
        radiance = radiance.subspan(taken);
        standard_error = standard_error.subspan(taken);
        if (radiance_.size() == band_values)
            finish_band();
    }
}

// Cuts a row of tiles off; those at the right and bottom edges of the image may be smaller.
void ErrorEstimator::finish_band() {
    const std::size_t rows = radiance_.size() / row_values_;
    for (std::size_t left = 0; left < row_values_; left += 3 * tile_size) {
        const std::size_t right = std::min(left + 3 * tile_size, row_values_);
        Tile tile{static_cast<double>(rows * (right - left)), 0.0, 0.0};
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t value = left; value < right; ++value) {
                const auto mean = static_cast<double>(radiance_[row * row_values_ + value]);
                const auto error = static_cast<double>(standard_error_[row * row_values_ + value]);
                const double median = median_about(radiance_, row_values_, row, value);
                tile.squares += error * error;
                tile.relative_squares += error * error / (squared_limit(mean, error, median) + relative_offset);
            }
        }
        tiles_.push_back(tile);
    }
    radiance_.clear();
    standard_error_.clear();
}

// The root of the mean over tiles, which are independent of each other: the variance of their sum is estimated by the
// sum of the squares of their deviations from the mean. That their expectations differ too only adds to it.
Interval ErrorEstimator::root_mean(double Tile::*squares, double exaggeration) const {
    double value_count = 0.0;
    double sum = 0.0;
    for (const Tile &tile : tiles_) {
        value_count += tile.value_count;
        sum += tile.*squares;
    }
    const double mean = sum / value_count;
    if (mean == 0.0)
        return {0.0, 0.0, 0.0};
    if (!std::isfinite(mean))
        return unknown_error().rmse;
    double variance = 0.0;
    for (const Tile &tile : tiles_) {
        const double deviation = tile.*squares - mean * tile.value_count;
        variance += deviation * deviation;
    }
    const double estimate = std::sqrt(mean);
    const double spread = std::sqrt(1.0 + normal_95 * std::sqrt(variance) / sum);
    return {estimate, estimate / (spread * exaggeration), estimate * spread};
}

ErrorEstimate ErrorEstimator::result(double exaggeration) {
    if (!radiance_.empty())
        finish_band();
    return {root_mean(&Tile::squares, exaggeration), root_mean(&Tile::relative_squares, exaggeration)};
}

} // namespace pt
