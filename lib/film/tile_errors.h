// Expected squared errors of a tile's pixels (shaders/pixel_error.h). Devices compute the same in estimate.comp. No
// tile depends on other tiles.
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

// Limits the relative errors of black pixels.
inline constexpr double relative_offset = 0.01;

using gpu::squared;

struct TileValues {
    std::size_t width;
    std::size_t height;
    double sample_count;
    std::uint64_t rejected{};
    // Rows have tile_size values even in narrower tiles.
    std::array<std::array<PixelValue, 3>, tile_size * tile_size> pixels{};
};

// Expected squared errors of values x with expected values r, summed over channels. Pixels outside the image have 0.
struct PixelErrors {
    using Numbers = std::array<double, tile_size * tile_size>;

    Numbers square{};          // (x - r)^2
    Numbers relative_square{}; // (x - r)^2 / (r^2 + 0.01), except for light that one part hit
    Numbers met_once{};        // relative squares of light that one part hit, with r from the other part
    Numbers as_lamps{};        // relative squares of light that one part hit, with r = x
    Numbers met_again{};       // number of bright values in both parts
    Numbers unseen{};          // expected relative squares from light that no sample of the pixel hit; its neighbors
                               // show this light
};

PixelErrors pixel_errors(const TileValues &tile);

struct ErrorSquares {
    double sum = 0.0;              // infinite if unknown
    double of_pixels = 0.0;        // sum of each pixel's sum squared
    double of_tiles = 0.0;         // sum of each tile's sum squared
    double times_tile_sizes = 0.0; // sum of each tile's sum times its number of values
};

struct TileErrors {
    double value_count = 0.0;
    double squares_of_tile_sizes = 0.0; // sum of each tile's squared number of values
    ErrorSquares square;
    ErrorSquares relative_square;
    ErrorSquares met_once;
    ErrorSquares as_lamps;
    double met_again = 0.0;
    double unseen = 0.0;
    std::uint64_t rejected = 0;

    // The relative squares without use of other tiles.
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
