// The error of an image, estimated from the means of the film's two parts. Pure arithmetic; Renderer feeds it with the
// film.
#pragma once

#include "lib/film/error_region.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pt {

struct PixelEstimates;

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

// What an image's samples were.
struct SampleConditions {
    std::uint32_t width; // pixels
    std::uint64_t sample_count;
    std::uint32_t sampler;
    bool may_miss_lamps; // found by chance, and so small that few samples have met them, if any
};

// What a tile of pixels says.
struct TileErrors {
    double value_count;               // pixels times channels
    double square;                    // sum of what is expected of (x - r)^2; infinite if it is unknown
    double square_of_pixels;          // sum over pixels of the squares of their sums over channels
    double relative_square;           // the same of (x - r)^2 / (r^2 + 0.01)
    double relative_square_of_pixels; // likewise
    double unseen;                    // the same of light that no sample met
    std::uint64_t rejected;           // samples left out
};

class ErrorEstimator {
public:
    explicit ErrorEstimator(const SampleConditions &conditions) : conditions_(conditions) {}

    // Takes consecutive pixels with their standard errors, the first being the first of the image.
    void add(const PixelEstimates &pixels);

    // Takes a tile of pixels. The last bits of the result depend on the order of the tiles.
    void add(const TileErrors &tile);

    // Of all pixels taken, at least one row.
    ErrorEstimate result();

    // Samples left out of them.
    std::uint64_t rejected() const { return rejected_; }

private:
    // Squares that are expected of errors, summed over an image.
    class Squares {
    public:
        void add(double value_count, double square, double square_of_pixels) {
            tiles_.push_back({value_count, square});
            value_count_ += value_count;
            sum_ += square;
            sum_of_pixel_squares_ += square_of_pixels;
        }

        double sum() const { return sum_; }
        // How many pixels with equal errors would make the sum as uncertain.
        double pixel_count() const;
        // The root of their mean, if other squares are added to the sum.
        Interval root_mean(double other_squares, bool uncertain, double margin, double exaggeration) const;

    private:
        struct Tile {
            double value_count;
            double square;
        };

        std::vector<Tile> tiles_;
        double value_count_ = 0.0; // of all tiles
        double sum_ = 0.0;
        double sum_of_pixel_squares_ = 0.0;
    };

    void finish_band();
    void add_region(std::size_t left, std::size_t width, std::size_t height);
    RegionChannel channel_of(std::size_t channel, std::size_t left, std::size_t width, std::size_t height) const;

    SampleConditions conditions_;
    std::vector<float> radiance_; // of a band of regions that is not complete
    std::vector<float> standard_error_;
    std::vector<float> lesser_;
    Squares squares_;
    Squares relative_squares_;
    double unseen_ = 0.0;
    std::uint64_t rejected_ = 0;
};

} // namespace pt
