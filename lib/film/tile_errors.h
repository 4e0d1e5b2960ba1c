// Expected squared errors of a tile's pixels (shaders/pixel_error.h). Devices compute the same in estimate.comp.
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

// Keeps the relative errors of black pixels finite.
inline constexpr double relative_offset = 0.01;

using gpu::squared;

struct TileValues {
    std::size_t width;
    std::size_t height;
    double sample_count;
    std::uint64_t rejected{};
    // Rows have tile_size values, also in narrower tiles.
    std::array<std::array<PixelValue, 3>, tile_size * tile_size> pixels{};
};

struct ErrorSquares {
    double sum = 0.0;              // infinite if unknown
    double of_pixels = 0.0;        // sum of squares of pixels' sums
    double of_tiles = 0.0;         // sum of squares of tiles' sums
    double times_tile_sizes = 0.0; // sum over tiles of sum * number of values
};

struct TileErrors {
    double value_count = 0.0;
    double squares_of_tile_sizes = 0.0; // sum over tiles of (number of values)^2
    ErrorSquares square;
    ErrorSquares relative_square;
    ErrorSquares met_once;
    ErrorSquares as_lamps;
    double met_again = 0.0;
    double unseen = 0.0;
    std::uint64_t rejected = 0;

    // The squared relative errors, estimated from this tile alone.
    double own_square() const { return relative_square.sum + as_lamps.sum + unseen; }
};

TileErrors tile_errors(const TileValues &tile);

// Computes a tile's errors only when its samples have changed.
class FilmErrors {
public:
    // Fills `rows` with whole rows of the film, from first_row on.
    using ReadRows = std::function<void(std::uint32_t first_row, PixelSums &rows)>;

    std::span<const TileErrors> of(const TileSamples &samples, double unit, const ReadRows &read);

    void forget() noexcept { tiles_.clear(); }

private:
    TileSamples samples_;
    std::vector<TileErrors> tiles_;
};

} // namespace pt
