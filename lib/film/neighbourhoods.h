// What surrounds each pixel of a tile, in one channel: the pixel itself and those of the tile that touch it.
#pragma once

#include "shaders/gpu_layout.h"

#include <array>
#include <cstddef>

namespace pt {

inline constexpr std::size_t tile_size = gpu::TILE_SIZE;

// A number for each pixel of a tile, row by row; rows are tile_size apart, also where the tile is narrower.
using TileFloats = std::array<float, tile_size * tile_size>;

// Numbers >= 0 of the pixels of a tile.
struct TilePlane {
    std::size_t width;
    std::size_t height;
    const float *values; // as in TileFloats
};

struct Neighbourhoods { // gpu::Neighbourhood; undefined beyond the edge
    TileFloats median;
    TileFloats largest;
};

Neighbourhoods find_neighbourhoods(const TilePlane &tile);

} // namespace pt
