#include "lib/film/error_estimate.h"

#include "shaders/specialization.h"

#include <pt/stats.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace pt {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double channels = 3.0;

// An estimate is uncertain if unseen light causes more than this fraction of the squared error. Calibrated.
constexpr double much_unseen = 0.1;

// An estimate is uncertain if rarer light could multiply the squared error by this factor. Calibrated.
constexpr double much_more = 3.0;

// Halton points are the same in all pixels, so errors of neighbors are correlated and estimates have a larger variance.
// Calibrated.
double margin(std::uint32_t sampler) {
    return sampler == PT_SAMPLER_HALTON ? 1.2 : 1.0;
}

// At sample counts where quasi-random errors fall more slowly than N^-1/2, the difference of the parts is too small.
// Calibrated.
double margin_of_sequence(std::uint32_t sampler) {
    return sampler == PT_SAMPLER_RANDOM ? 1.0 : 1.145;
}

// Effective number of pixels: the number of equal squares whose sum has the same relative variance.
double pixel_count(const ErrorSquares &squares) {
    return squares.sum > 0.0 ? squared(squares.sum) / squares.of_pixels : infinity;
}

void add_squares(ErrorSquares &to, const ErrorSquares &other, double factor = 1.0) {
    to.sum += factor * other.sum;
    to.of_pixels += squared(factor) * other.of_pixels;
    to.of_tiles += squared(factor) * other.of_tiles;
    to.times_tile_sizes += factor * other.times_tile_sizes;
}

// Returns the factor for squared relative errors in pixels where only one half of the samples has hit a light. Let w be
// the expected number of hits in a pixel, and q = e^(-w / 2). Exactly one half hits the light in a fraction 2 q (1 - q)
// of the pixels, both halves in (1 - q)^2. If hits by both halves are b times as frequent as hits by exactly one, w = 2
// ln(1 + 2 b). If only one half hits the light in a pixel of mean T, the pixel's expected value is w T. So its error
// relative to this value is 1 / w times its error relative to T.
double square_by_hits(double met_once, double met_again) {
    const double hits = 2.0 * std::log1p(2.0 * met_again / (met_once + 1.0));
    return std::max(1.0, 1.0 / squared(hits));
}

// If only one half of the samples has hit a light, its squared error has two estimates: met_once, and as_lamps times
// square_by_hits(). The smaller one counts.
ErrorSquares relative_squares(const TileErrors &all, double met_again) {
    const double factor = square_by_hits(all.as_lamps.sum / channels, met_again);
    ErrorSquares squares = all.relative_square;
    if (all.met_once.sum > factor * all.as_lamps.sum)
        add_squares(squares, all.as_lamps, factor);
    else
        add_squares(squares, all.met_once);
    return squares;
}

} // namespace

// The root of a sum over n pixels has a relative standard deviation of about 1 / (2 sqrt(n)). The added fraction is a
// little larger, because understated errors do more harm. Calibrated.
double share_added(double pixel_count) {
    return 0.6 / std::sqrt(pixel_count) + 2.5 / pixel_count;
}

// The logarithm of the root of a sum of m squared normal variables has the standard deviation 1 / sqrt(2 m). A
// normal variable x has E x^4 = 3, so pixel_count() of m squares is n = m / 3. The true error varies as much as its
// estimate, so the ratio of both has the standard deviation 1 / sqrt(3 n).
double spread_of_pixels(double pixel_count) {
    return std::exp(normal_95 / std::sqrt(3.0 * pixel_count));
}

ErrorEstimate unknown_error() {
    return {{infinity, 0.0, infinity}, {infinity, 0.0, infinity}, 0};
}

pt_error_estimate stated(const ErrorEstimate &error) {
    return {.struct_size = sizeof(pt_error_estimate),
            .uncertain = error.uncertain,
            .rmse = error.rmse.estimate,
            .rmse_low = error.rmse.low,
            .rmse_high = error.rmse.high,
            .relative_rmse = error.relative_rmse.estimate,
            .relative_rmse_low = error.relative_rmse.low,
            .relative_rmse_high = error.relative_rmse.high};
}

bool hides_error(std::uint64_t rejected_samples, std::uint64_t samples) {
    return rejected_samples > samples >> 20;
}

std::uint64_t next_check(std::uint64_t sample_count) {
    if (sample_count < min_estimate_samples)
        return min_estimate_samples;
    const std::uint64_t step = std::bit_floor(sample_count) / 4;
    return (sample_count / step + 1) * step;
}

bool is_check(std::uint64_t sample_count) {
    return sample_count >= min_estimate_samples && next_check(sample_count - 1) == sample_count;
}

double exaggeration(std::uint32_t sampler) {
    // The root of 2^p - 1 (shaders/README.md, section 11): p = 1 for random points, at most 3 for scrambled nets (Owen
    // 1997).
    return sampler == PT_SAMPLER_RANDOM ? 1.0 : std::sqrt(7.0);
}

bool finds_lamps_by_chance(std::uint32_t estimator, std::uint32_t max_path_length) {
    return max_path_length > 1 && estimator != PT_ESTIMATOR_BEST && !gpu::samples_lamps(estimator);
}

void ErrorEstimator::add(const TileErrors &tiles) {
    all_.value_count += tiles.value_count;
    all_.squares_of_tile_sizes += tiles.squares_of_tile_sizes;
    add_squares(all_.square, tiles.square);
    add_squares(all_.relative_square, tiles.relative_square);
    add_squares(all_.met_once, tiles.met_once);
    add_squares(all_.as_lamps, tiles.as_lamps);
    all_.met_again += tiles.met_again;
    all_.unseen += tiles.unseen;
    all_.rejected += tiles.rejected;
}

// Let S be the sum of n values, and s the sum of a tile's c values. The variance of S is estimated by the sum of (s - c
// S / n)^2 over tiles.
Interval ErrorEstimator::root_mean(const ErrorSquares &squares, double other_squares, bool uncertain) const {
    const bool shows_nothing = squares.sum + other_squares == 0.0;
    if (!std::isfinite(squares.sum) || (shows_nothing && uncertain))
        return unknown_error().rmse;
    if (shows_nothing)
        return {0.0, 0.0, 0.0};
    const double mean = squares.sum / all_.value_count;
    const double variance =
        squares.of_tiles - 2.0 * mean * squares.times_tile_sizes + mean * mean * all_.squares_of_tile_sizes;
    const double estimate = std::sqrt((squares.sum + other_squares) / all_.value_count) *
                            (1.0 + share_added(pixel_count(squares))) * margin(conditions_.sampler);
    const double relative_deviation = squares.sum > 0.0 ? std::sqrt(std::max(variance, 0.0)) / squares.sum : 0.0;
    const double of_tiles = std::sqrt(1.0 + normal_95 * relative_deviation);
    const double spread =
        std::max(of_tiles, spread_of_pixels(pixel_count(squares))) * (uncertain ? uncertain_factor : 1.0);
    const double margin_within_bounds = uncertain ? 1.0 : std::min(margin_of_sequence(conditions_.sampler), spread);
    return {estimate * margin_within_bounds, estimate / (spread * exaggeration(conditions_.sampler)),
            estimate * spread};
}

// The number of pixels where both parts hit light has a standard deviation of about its square root. The number is not
// used if lamps are found by chance, because rarer light may then be missing.
ErrorEstimate ErrorEstimator::result() const {
    const double again = all_.met_again / channels;
    const bool by_chance = conditions_.finds_lamps_by_chance;
    const ErrorSquares relative = relative_squares(all_, by_chance ? 0.0 : again + 0.5);
    const ErrorSquares most =
        relative_squares(all_, by_chance ? 0.0 : std::max(again - normal_95 * std::sqrt(again), 0.0));
    std::uint32_t uncertain = 0;
    if (pixel_count(all_.square) < few_pixels)
        uncertain |= PT_UNCERTAIN_RMSE;
    if (pixel_count(relative) < few_pixels || most.sum > much_more * relative.sum)
        uncertain |= PT_UNCERTAIN_RELATIVE_RMSE;
    if (all_.unseen > much_unseen * (relative.sum + all_.unseen))
        uncertain |= PT_UNCERTAIN_UNSEEN;
    if (conditions_.may_miss_lamps)
        uncertain |= PT_UNCERTAIN_UNMET;
    constexpr std::uint32_t rmse_bits = PT_UNCERTAIN_RMSE | PT_UNCERTAIN_UNMET;
    constexpr std::uint32_t relative_bits = PT_UNCERTAIN_RELATIVE_RMSE | PT_UNCERTAIN_UNSEEN | PT_UNCERTAIN_UNMET;
    ErrorEstimate error{root_mean(all_.square, 0.0, (uncertain & rmse_bits) != 0),
                        root_mean(relative, all_.unseen, (uncertain & relative_bits) != 0), uncertain};
    if (most.sum > relative.sum)
        error.relative_rmse.high *= std::sqrt((most.sum + all_.unseen) / (relative.sum + all_.unseen));
    return error;
}

} // namespace pt
