// The error of an image, estimated from the means of the film's two parts. Pure arithmetic; Renderer feeds it with the
// film.
#pragma once

#include "lib/film/tile_errors.h"

#include <pt/stats.h>

#include <cstdint>

namespace pt {

// An estimate and its bounds of 95% confidence.
struct Interval {
    double estimate;
    double low;
    double high;
};

struct ErrorEstimate {
    Interval rmse;           // root of the mean of (x - r)^2 over pixels and channels
    Interval relative_rmse;  // of (x - r)^2 / (r^2 + 0.01)
    std::uint32_t uncertain; // PT_UNCERTAIN_* of pt/stats.h
};

// With fewer samples the difference of the film's parts says too little.
inline constexpr std::uint32_t min_estimate_samples = 16;

// For the normal distribution, 95% lie within this many standard deviations.
inline constexpr double normal_95 = 1.96;

// An estimate from fewer pixels is uncertain. Calibrated.
inline constexpr double few_pixels = 4.0;

// Of an estimate whose squares behave as those of so many pixels with equal errors: the share of the root that is added
// to it, and the factor from it to its bounds.
double share_added(double pixel_count);
double spread_of_pixels(double pixel_count);

// How far the bounds are from an estimate that is uncertain, beyond what the spread over tiles says: calibrated.
inline constexpr double uncertain_factor = 2.0;

// What is known without samples.
ErrorEstimate unknown_error();

// As pt.h gives it.
pt_error_estimate stated(const ErrorEstimate &error);

// Whether so many of an image's samples were left out that its error is unknown. A sample that was too bright may have
// carried more than 2^20 times the brightest emission (gpu_layout.h, FILM_MAX_EXPONENT), so one such sample in 2^20 may
// outweigh all light in the picture.
bool hides_error(std::uint64_t rejected_samples, std::uint64_t samples);

// The sample count, greater than the given one, at which the error is looked at next: 16, then quarters of powers of
// two.
std::uint64_t next_check(std::uint64_t sample_count);
bool is_check(std::uint64_t sample_count);

// Factor >= 1 by which the error that the film's parts show may exceed the true one, with a sampler of pt.h.
double exaggeration(std::uint32_t sampler);

// Whether an estimator of pt.h, not the default, samples no lamps, so that paths of such a length meet them by chance.
bool finds_lamps_by_chance(std::uint32_t estimator, std::uint32_t max_path_length);

// What an image's samples were.
struct SampleConditions {
    std::uint32_t sampler;
    bool may_miss_lamps; // found by chance, and so small that few samples have met them, if any
    bool finds_lamps_by_chance = false;
};

class ErrorEstimator {
public:
    explicit ErrorEstimator(const SampleConditions &conditions) : conditions_(conditions) {}

    // Takes a tile, or the sum of several. The last bits of the result depend on their order.
    void add(const TileErrors &tiles);

    // Of all tiles taken, at least one.
    ErrorEstimate result() const;

    // Samples left out of them.
    std::uint64_t rejected() const { return all_.rejected; }

private:
    // The root of the mean of some squares, if others are added to their sum.
    Interval root_mean(const ErrorSquares &squares, double other_squares, bool uncertain) const;

    SampleConditions conditions_;
    TileErrors all_;
};

} // namespace pt
