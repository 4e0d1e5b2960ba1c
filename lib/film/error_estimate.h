// The error of an image, estimated from the standard errors of its pixels. Pure arithmetic; Renderer feeds it with
// the film.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// An estimate and its bounds of 95% confidence.
struct Interval {
    double estimate;
    double low;
    double high;
};

struct ErrorEstimate {
    Interval rmse;          // root of the mean of (x - r)^2 over pixels and channels
    Interval relative_rmse; // of (x - r)^2 / (r^2 + 0.01)
};

// With fewer samples the difference of the film's parts says too little.
inline constexpr std::uint32_t min_estimate_samples = 16;

// What is known without samples.
ErrorEstimate unknown_error();

// Whether so many of an image's samples were left out that its error is unknown. Of those that were too bright each may
// have carried more than 2^20 times the brightest emission (gpu_layout.h, FILM_MAX_EXPONENT): from one in 2^20 on, they
// may outweigh all light in the picture.
bool hides_error(std::uint64_t rejected_samples, std::uint64_t samples);

// The sample count, greater than the given one, at which the error is looked at next: 16, then eighths of powers of
// two.
std::uint64_t next_check(std::uint64_t sample_count);
bool is_check(std::uint64_t sample_count);

// Factor >= 1 by which the error that the film's parts show may exceed the true one, with a sampler of pt.h.
double exaggeration(std::uint32_t sampler);

// Square of a pixel's limit, for the denominator of the relative error, in one channel of a pixel: from its mean and
// standard error, and the median of the means about it.
double squared_limit(double mean, double standard_error, double median);

class ErrorEstimator {
public:
    explicit ErrorEstimator(std::uint32_t width);

    // Takes consecutive pixels, the first being the first of the image: R, G, B of radiance and of its standard error.
    void add(std::span<const float> radiance, std::span<const float> standard_error);

    // Of all pixels taken: whole rows, at least one.
    ErrorEstimate result(double exaggeration);

private:
    // Sums over a part of the image.
    struct Tile {
        double value_count;
        double squares; // of errors
        double relative_squares;
    };

    void finish_band();
    Interval root_mean(double Tile::*squares, double exaggeration) const;

    std::size_t row_values_;
    std::vector<float> radiance_; // of a band of tiles that is not complete
    std::vector<float> standard_error_;
    std::vector<Tile> tiles_;
};

} // namespace pt
