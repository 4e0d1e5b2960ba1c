// What the pixels of a region say about the error of an image, on the host, by shaders/pixel_error.h: the expected
// squares of their errors, their sums, and how they are distributed. estimate.comp computes the same on devices. A
// region depends on nothing outside it, so regions can be looked at in any order and anywhere.
#pragma once

#include "lib/film/neighbourhoods.h"
#include "shaders/pixel_error.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pt {

// Keeps black pixels from counting without bound.
inline constexpr double relative_offset = 0.01;

using gpu::squared;

// The pixels of a region, row by row, smaller at the right and bottom edges of an image, in planes: R of all pixels,
// then G, then B.
struct RegionValues {
    std::size_t width;
    std::size_t height;
    std::size_t row_stride;      // from a row to the next
    std::size_t plane_stride;    // from a plane to the next
    const float *mean;           // of all samples of the first pixel
    const float *standard_error; // of that mean
    const float *lesser;         // the smaller of the means of the film's two parts
};

// The expected squares of the errors of pixels with values x and limits r, summed over channels, row by row. Rows are
// region_size apart, whatever the width of the region.
struct PixelErrors {
    using Numbers = std::array<double, region_size * region_size>;

    Numbers square;          // of (x - r)^2
    Numbers relative_square; // of (x - r)^2 / (r^2 + 0.01), as far as the samples tell, but for values met once
    Numbers met_once;        // the same of values met once, with what is known without the part that met them as limits
    Numbers as_lamps;        // likewise, with their own means as limits
    Numbers met_again;       // how many values stand out from what is about them in both parts of the film
    Numbers unseen; // the same of light beside the pixel that may be in it too, but that none of its samples met
};

// sample_counts: samples of a pixel, for each tile of the region, row by row.
void find_pixel_errors(const RegionValues &region, std::span<const double> sample_counts, PixelErrors &to);

// The sum of relative_square, as_lamps and unseen over the values of a tile, from the samples of that tile alone;
// infinite if it is unknown.
double own_square(const RegionValues &tile, double sample_count);

// The squares that are expected of errors, summed over pixels and channels, and how they lie.
struct ErrorSquares {
    double sum = 0.0;              // infinite if it is unknown
    double of_pixels = 0.0;        // sum over pixels of the squares of their sums over channels
    double of_tiles = 0.0;         // sum over tiles of the squares of their sums
    double times_tile_sizes = 0.0; // sum over tiles of their sums, each times the number of its values
};

// What a region says.
struct RegionErrors {
    double value_count = 0.0;           // pixels times channels
    double squares_of_tile_sizes = 0.0; // sum over tiles of the squares of the numbers of their values
    ErrorSquares square;                // of (x - r)^2
    ErrorSquares relative_square;       // of (x - r)^2 / (r^2 + 0.01), but for values met once
    ErrorSquares met_once;              // the same of these, by what is known without them
    ErrorSquares as_lamps;              // likewise, by their own means: about 1 of each
    double met_again = 0.0;             // values
    double unseen = 0.0;                // the same of light that no sample met
    std::uint64_t rejected = 0;         // samples left out
};

// The pixels of a region, with what is known of its samples.
struct RegionPixels {
    static constexpr std::size_t most_tiles = (region_size / tile_size) * (region_size / tile_size);

    RegionValues values;
    std::uint64_t rejected;                         // samples left out
    std::array<double, most_tiles> sample_counts{}; // of a pixel, for each tile of the region, row by row
};

RegionErrors region_errors(const RegionPixels &region);

// Of the pixels of one tile: what is expected of the sum of its values' relative errors squared, unseen
// light among them, as far as its samples alone tell; infinite where that is unknown.
double own_square_of(const RegionPixels &tile);

} // namespace pt
