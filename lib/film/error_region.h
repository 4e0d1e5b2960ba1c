// What the pixels of a region say about the error of an image, on the host; pixel_error.glsl and estimate.comp say the
// same on devices. It depends on nothing outside the region, so regions can
// be looked at in any order and anywhere.
#pragma once

#include "shaders/gpu_layout.h"

#include <cstddef>
#include <span>
#include <vector>

namespace pt {

inline constexpr std::size_t region_size = gpu::REGION_SIZE;
inline constexpr std::size_t tile_size = gpu::TILE_SIZE;

// Keeps black pixels from counting without bound.
inline constexpr double relative_offset = 0.01;

inline double squared(double value) {
    return value * value;
}

// One channel of the pixels of a region, row by row; at the right and bottom edges of an image regions are smaller.
struct RegionChannel {
    std::size_t width;
    std::size_t height;
    std::vector<double> mean;           // of all samples
    std::vector<double> standard_error; // of that mean
    std::vector<double> lesser;         // the smaller of the means of the film's two parts
};

// What is expected of one value of a pixel, x with the limit r.
struct ValueError {
    double square;          // of (x - r)^2
    double relative_square; // of (x - r)^2 / (r^2 + 0.01), as far as the samples tell
    double unseen; // the same of light beside the pixel that may be in it too, but that none of its samples met
};

// Of each value of the channel. sample_counts: of a pixel, for each tile of the region, row by row.
std::vector<ValueError> value_errors(const RegionChannel &channel, std::span<const double> sample_counts);

// The sum of relative_square and unseen over the values of a channel of a tile, by what that tile alone knows; infinite
// if it is unknown.
double own_square(const RegionChannel &tile, double sample_count);

} // namespace pt
