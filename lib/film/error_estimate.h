#pragma once

#include "lib/film/tile_errors.h"

#include <pt/stats.h>

#include <cstdint>

namespace pt {

struct Interval {
    double estimate;
    double low;
    double high;
};

struct ErrorEstimate {
    Interval rmse;
    Interval relative_rmse;  // (x - r)^2 is divided by r^2 + 0.01
    std::uint32_t uncertain; // PT_UNCERTAIN_*
};

// With fewer samples per pixel the error is unknown.
inline constexpr std::uint32_t min_estimate_samples = 16;

inline constexpr double normal_95 = 1.96;

// An estimate from fewer equal pixels is uncertain. Calibrated.
inline constexpr double few_pixels = 4.0;

// `pixel_count` is an effective number of pixels. share_added() is the fraction to add to an estimate,
// spread_of_pixels() the factor between the estimate and its bounds.
double share_added(double pixel_count);
double spread_of_pixels(double pixel_count);

// Widens the bounds of uncertain estimates. Calibrated.
inline constexpr double uncertain_factor = 2.0;

ErrorEstimate unknown_error();

pt_error_estimate stated(const ErrorEstimate &error);

// Whether rejected samples make the error unknown. Rejected samples are so bright (FILM_MAX_EXPONENT) that one in 2^20
// may outweigh all others.
bool hides_error(std::uint64_t rejected_samples, std::uint64_t samples);

// The error is checked at 16 samples, then four times per doubling.
std::uint64_t next_check(std::uint64_t sample_count);
bool is_check(std::uint64_t sample_count);

// The largest factor by which the difference of the parts may overstate the error. `sampler` is a PT_SAMPLER_*.
double exaggeration(std::uint32_t sampler);

bool finds_lamps_by_chance(std::uint32_t estimator, std::uint32_t max_path_length);

struct SampleConditions {
    std::uint32_t sampler;
    bool may_miss_lamps;
    bool finds_lamps_by_chance = false;
};

class ErrorEstimator {
public:
    explicit ErrorEstimator(const SampleConditions &conditions) : conditions_(conditions) {}

    // The order of calls changes the last bits of the result.
    void add(const TileErrors &tiles);

    ErrorEstimate result() const;

    std::uint64_t rejected() const { return all_.rejected; }

private:
    Interval root_mean(const ErrorSquares &squares, double other_squares, bool uncertain) const;

    SampleConditions conditions_;
    TileErrors all_;
};

} // namespace pt
