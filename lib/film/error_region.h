// What the pixels of a region say about the error of an image. It depends on nothing outside the region, so regions can
// be looked at in any order and anywhere.
#pragma once

#include <cstddef>
#include <vector>

namespace pt {

// Pixels of a region's side, and of a tile's, of which a region has 4 x 4: large against what neighbours share, small
// enough for hundreds of tiles in a small image.
inline constexpr std::size_t region_size = 32;
inline constexpr std::size_t tile_size = 8;

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

// Of each value of the channel, after so many samples a pixel.
std::vector<ValueError> value_errors(const RegionChannel &channel, double sample_count);

} // namespace pt
