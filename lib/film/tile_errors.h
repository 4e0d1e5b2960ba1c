// Expected squares of the errors in a tile's pixels, on the host, by shaders/pixel_error.h. estimate.comp computes the
// same on devices. A tile depends on nothing outside it, so any order gives the same result.
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

struct TileValues {
    std::size_t width;
    std::size_t height;
    double sample_count;      // samples of a pixel
    std::uint64_t rejected{}; // samples left out
    // In each channel, row by row; rows are tile_size apart even in narrower tiles.
    std::array<std::array<PixelValue, 3>, tile_size * tile_size> pixels{};
};

// Expected squares for values x with limits r, summed over channels; 0 beyond the edge.
struct PixelErrors {
    using Numbers = std::array<double, tile_size * tile_size>;

    Numbers square{};          // (x - r)^2
    Numbers relative_square{}; // (x - r)^2 / (r^2 + 0.01), without values met once
    Numbers met_once{};        // as relative_square, of values that one part met, with limits r known from the other
    Numbers as_lamps{};        // as relative_square, of values met once, with their own means as r
    Numbers met_again{};       // values that stand out from their surroundings in both parts of the film
    Numbers unseen{}; // as relative_square, of a neighbor's light that may reach into the pixel, but was not met
};

PixelErrors pixel_errors(const TileValues &tile);

// Expected squares of errors, summed over pixels and channels, and their distribution.
struct ErrorSquares {
    double sum = 0.0;              // infinite if unknown
    double of_pixels = 0.0;        // sum over pixels of the squares of their sums over channels
    double of_tiles = 0.0;         // sum over tiles of the squares of their sums
    double times_tile_sizes = 0.0; // sum over tiles of their sums times the number of their values
};

// One tile, or several together.
struct TileErrors {
    double value_count = 0.0;           // pixels times channels
    double squares_of_tile_sizes = 0.0; // sum over tiles of the squares of the numbers of their values
    ErrorSquares square;                // (x - r)^2
    ErrorSquares relative_square;       // (x - r)^2 / (r^2 + 0.01), without values met once
    ErrorSquares met_once;              // as in PixelErrors
    ErrorSquares as_lamps;              // as in PixelErrors: about 1 each
    double met_again = 0.0;
    double unseen = 0.0;        // as in PixelErrors
    std::uint64_t rejected = 0; // samples left out

    // Sum of all relative squares, as far as a tile alone tells.
    double own_square() const { return relative_square.sum + as_lamps.sum + unseen; }
};

TileErrors tile_errors(const TileValues &tile);

// The errors of all tiles of a film, kept: a tile is looked at again only when its samples have changed.
class FilmErrors {
public:
    // Fills `rows` with whole rows of the film, from first_row on.
    using ReadRows = std::function<void(std::uint32_t first_row, PixelSums &rows)>;

    // By tile.
    std::span<const TileErrors> of(const TileSamples &samples, double unit, const ReadRows &read);

    // Call when the film is replaced.
    void forget() noexcept { tiles_.clear(); }

private:
    TileSamples samples_;
    std::vector<TileErrors> tiles_;
};

} // namespace pt
