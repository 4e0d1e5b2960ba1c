// What a region says about the error of an image: what is expected of the squares of its pixels' errors, summed up, and
// how they lie. The same on the host as estimate.comp says it on devices.
#pragma once

#include "lib/film/error_region.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace pt {

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
    ErrorSquares relative_square;       // of (x - r)^2 / (r^2 + 0.01), but for values met once (error_region.h)
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
