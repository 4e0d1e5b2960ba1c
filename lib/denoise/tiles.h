// Numbers of an image's tiles of 8x8 pixels; with its neighbors, a tile has hundreds of values.
#pragma once

#include "lib/denoise/halves.h"

#include <algorithm>
#include <cmath>

namespace pt {

struct Tiles {
    static constexpr std::size_t width = 8; // pixels

    explicit Tiles(const Halves &halves) :
        columns((halves.width + width - 1) / width),
        rows((halves.height + width - 1) / width),
        numbers(columns * rows) {}

    std::size_t columns;
    std::size_t rows;
    std::vector<double> numbers; // row by row
};

// Averages each tile with its neighbors, with half of the weight for each step away. Outermost tiles repeat beyond the
// edge, so the sum of all stays.
void spread(Tiles &tiles);

// Between two tiles, and how near to the second.
struct Place {
    std::size_t first;
    std::size_t second;
    double share;

    Place(std::size_t pixel, std::size_t count);
};

// Linear between the middles of tiles, so without seams.
double at(const Tiles &tiles, const Place &x, const Place &y);

// Calls visit(tile, x, y) for all pixels, tile by tile.
template <typename Visit>
void for_each_pixel(const Halves &halves, Visit &&visit) {
    const Tiles tiles(halves);
    for (std::size_t tile = 0; tile < tiles.numbers.size(); ++tile) {
        const std::size_t left = tile % tiles.columns * Tiles::width;
        const std::size_t top = tile / tiles.columns * Tiles::width;
        for (std::size_t y = top; y < std::min(top + Tiles::width, halves.height); ++y)
            for (std::size_t x = left; x < std::min(left + Tiles::width, halves.width); ++x)
                visit(tile, x, y);
    }
}

} // namespace pt
