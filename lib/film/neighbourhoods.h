// What surrounds each pixel of a region, in one channel: the pixel itself and those of the region that touch it.
#pragma once

#include "shaders/gpu_layout.h"

#include <array>
#include <cstddef>

namespace pt {

inline constexpr std::size_t region_size = gpu::REGION_SIZE;
inline constexpr std::size_t tile_size = gpu::TILE_SIZE;

// Numbers >= 0 of a rectangle of pixels.
struct PixelPlane {
    std::size_t width;
    std::size_t height;
    std::size_t stride; // from a row to the next
    const float *values;
};

// A number for each pixel of a region. Rows are region_size apart, whatever the width; numbers outside the region are
// undefined.
using RegionFloats = std::array<float, region_size * region_size>;

struct Neighbourhoods { // gpu::Neighbourhood
    RegionFloats median;
    RegionFloats largest;
};

void find_neighbourhoods(const PixelPlane &region, Neighbourhoods &to);

// Only the largest, for the pixels of one tile. Rows are tile_size apart.
std::array<float, tile_size * tile_size> largest_in_tile(const PixelPlane &tile);

} // namespace pt
