// The error of an image, estimated from the means of the film's two parts.
#pragma once

#include "lib/film/tile_errors.h"

#include <pt/stats.h>

#include <cstdint>

namespace pt {

// Bounds have 95% confidence.
struct Interval {
    double estimate;
    double low;
    double high;
};

struct ErrorEstimate {
    Interval rmse;           // root of the mean of (x - r)^2 over pixels and channels
    Interval relative_rmse;  // the same for (x - r)^2 / (r^2 + 0.01)
    std::uint32_t uncertain; // PT_UNCERTAIN_* of pt/stats.h
};

// The film's parts say too little with fewer samples.
inline constexpr std::uint32_t min_estimate_samples = 16;

// 95% of a normal distribution lie within this many standard deviations.
inline constexpr double normal_95 = 1.96;

// Fewer pixels give an uncertain estimate. Calibrated.
inline constexpr double few_pixels = 4.0;

// The share added to the root, and the factor from the estimate to its bounds, if it scatters like this many pixels
// with equal errors.
double share_added(double pixel_count);
double spread_of_pixels(double pixel_count);

// Widens the bounds of uncertain estimates. Calibrated.
inline constexpr double uncertain_factor = 2.0;

// The estimate without samples.
ErrorEstimate unknown_error();

pt_error_estimate stated(const ErrorEstimate &error);

// Whether rejected samples leave the error unknown. A rejected sample may have carried more than 2^20 times the
// brightest emission (gpu_layout.h, FILM_MAX_EXPONENT), so one in 2^20 may outweigh all light in the picture.
bool hides_error(std::uint64_t rejected_samples, std::uint64_t samples);

// The next sample count at which the error is checked: 16, then quarters of powers of two.
std::uint64_t next_check(std::uint64_t sample_count);
bool is_check(std::uint64_t sample_count);

// Factor >= 1 by which the error that the parts show may exceed the true one. sampler: PT_SAMPLER_*.
double exaggeration(std::uint32_t sampler);

// Whether paths hit lamps only by chance, because the estimator (PT_ESTIMATOR_*) does not sample them.
bool finds_lamps_by_chance(std::uint32_t estimator, std::uint32_t max_path_length);

struct SampleConditions {
    std::uint32_t sampler;
    bool may_miss_lamps; // found by chance, and so small that few samples, if any, have met them
    bool finds_lamps_by_chance = false;
};

class ErrorEstimator {
public:
    explicit ErrorEstimator(const SampleConditions &conditions) : conditions_(conditions) {}

    // Takes a tile, or the sum of several. Their order changes the last bits of the result.
    void add(const TileErrors &tiles);

    // Requires at least one tile.
    ErrorEstimate result() const;

    // Samples left out of the tiles.
    std::uint64_t rejected() const { return all_.rejected; }

private:
    // The root of a mean square. other_squares: added to the sum.
    Interval root_mean(const ErrorSquares &squares, double other_squares, bool uncertain) const;

    SampleConditions conditions_;
    TileErrors all_;
};

} // namespace pt
