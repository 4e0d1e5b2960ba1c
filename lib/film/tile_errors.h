// What the pixels of a tile say about the error of an image, on the host, by shaders/pixel_error.h: the expected
// squares of their errors, their sums, and how they are distributed. estimate.comp computes the same on devices. A tile
// depends on nothing outside it, so tiles can be looked at in any order and anywhere.
#pragma once

#include "lib/film/pixel_sums.h"
#include "lib/film/tile_samples.h"
#include "shaders/gpu_layout.h"
#include "shaders/pixel_error.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace pt {

inline constexpr std::size_t tile_size = gpu::TILE_SIZE;

// Keeps black pixels from counting without bound.
inline constexpr double relative_offset = 0.01;

using gpu::squared;

// The values of a tile's pixels, with what is known of its samples.
struct TileValues {
    std::size_t width;
    std::size_t height;
    double sample_count;      // of a pixel
    std::uint64_t rejected{}; // samples left out
    // In each channel, row by row; rows are tile_size apart, also where the tile is narrower.
    std::array<std::array<PixelValue, 3>, tile_size * tile_size> pixels{};
};

// The expected squares of the errors of pixels with values x and limits r, summed over channels; 0 beyond the edge.
struct PixelErrors {
    using Numbers = std::array<double, tile_size * tile_size>;

    Numbers square{};          // of (x - r)^2
    Numbers relative_square{}; // of (x - r)^2 / (r^2 + 0.01), as far as the samples tell, without values met once
    Numbers met_once{};  // the same for values met once, with limits r that are known without the part that met them
    Numbers as_lamps{};  // the same for values met once, with their own means as r
    Numbers met_again{}; // how many values stand out from what is about them in both parts of the film
    Numbers unseen{};    // the same for a neighbour's light that may reach into the pixel, but that no sample has met
};

PixelErrors pixel_errors(const TileValues &tile);

// The squares that are expected of errors, summed over pixels and channels, and how they lie.
struct ErrorSquares {
    double sum = 0.0;              // infinite if it is unknown
    double of_pixels = 0.0;        // sum over pixels of the squares of their sums over channels
    double of_tiles = 0.0;         // sum over tiles of the squares of their sums
    double times_tile_sizes = 0.0; // sum over tiles of their sums, each times the number of its values
};

// What a tile says, or several together.
struct TileErrors {
    double value_count = 0.0;           // pixels times channels
    double squares_of_tile_sizes = 0.0; // sum over tiles of the squares of the numbers of their values
    ErrorSquares square;                // of (x - r)^2
    ErrorSquares relative_square;       // of (x - r)^2 / (r^2 + 0.01), without values met once
    ErrorSquares met_once;              // the same for values met once, with limits r that are known without them
    ErrorSquares as_lamps;              // the same for values met once, with their own means as r: about 1 each
    double met_again = 0.0;             // values
    double unseen = 0.0;                // the same of light that no sample met
    std::uint64_t rejected = 0;         // samples left out

    // The sum of all relative squares, as far as a tile alone tells.
    double own_square() const { return relative_square.sum + as_lamps.sum + unseen; }
};

TileErrors tile_errors(const TileValues &tile);

// What all tiles of a film say, kept between looks: a tile is looked at again only when its samples have changed.
class FilmErrors {
public:
    // Reads the sums of whole rows of the film, from first_row on, as many pixels as rows has.
    using ReadRows = std::function<void(std::uint32_t first_row, PixelSums &rows)>;

    // By tile, of a film with this unit and these samples.
    std::span<const TileErrors> of(const TileSamples &samples, double unit, const ReadRows &read);

    // To be called when the film is replaced.
    void forget() noexcept { tiles_.clear(); }

private:
    TileSamples samples_; // of the last look
    std::vector<TileErrors> tiles_;
};

} // namespace pt
