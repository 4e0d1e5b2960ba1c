#pragma once

#include "lib/denoise/halves.h"

#include <algorithm>

namespace pt {

struct Tiles {
    static constexpr std::size_t width = 8;

    explicit Tiles(const Halves &halves) :
        columns((halves.width + width - 1) / width),
        rows((halves.height + width - 1) / width),
        numbers(columns * rows) {}

    std::size_t columns;
    std::size_t rows;
    std::vector<double> numbers;
};

// Averages each tile with its neighbors by the weights 1/4, 1/2, 1/4 along both axes. Tiles at the edge are repeated
// beyond the edge, so the sum over all tiles does not change.
void spread(Tiles &tiles);

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
