#include "lib/film/neighbourhoods.h"

#include "shaders/neighbourhood.h"

#include <algorithm>

namespace pt {

namespace {

// For each pixel of a row, the values to its left, in it and to its right, sorted. Missing ones come first.
struct SortedRow {
    std::array<float, tile_size> low;
    std::array<float, tile_size> middle;
    std::array<float, tile_size> high;

    gpu::Sorted at(std::size_t x) const { return {low[x], middle[x], high[x]}; }
};

SortedRow sorted_row(const TilePlane &tile, std::size_t y) {
    std::array<float, tile_size + 2> row{};
    row[0] = gpu::BELOW_ALL;
    std::copy_n(tile.values + y * tile_size, tile.width, row.begin() + 1);
    row[tile.width + 1] = gpu::BELOW_ALL;
    SortedRow to;
    for (std::size_t x = 0; x < tile_size; ++x) {
        const auto [low, middle, high] = gpu::sorted(row[x], row[x + 1], row[x + 2]);
        to.low[x] = low;
        to.middle[x] = middle;
        to.high[x] = high;
    }
    return to;
}

} // namespace

// Row by row, so that each row is sorted once.
Neighbourhoods find_neighbourhoods(const TilePlane &tile) {
    Neighbourhoods found{};
    std::array<SortedRow, 3> rows{sorted_row(tile, 0)};
    for (std::size_t y = 0; y < tile.height; ++y) {
        const SortedRow &above = rows[(y + 2) % 3];
        const SortedRow &row = rows[y % 3];
        SortedRow &below = rows[(y + 1) % 3];
        const bool is_first = y == 0;
        const bool is_last = y + 1 == tile.height;
        if (!is_last)
            below = sorted_row(tile, y + 1);
        const auto find = [&](std::size_t x, bool is_beside_edge) {
            const auto [median, largest] =
                tile.height == 1 ? gpu::neighbourhood_in_line(row.at(x))
                : tile.width == 1
                    ? gpu::neighbourhood_in_line(gpu::column_of(above.at(x), row.at(x), below.at(x), is_first, is_last))
                    : gpu::neighbourhood(above.at(x), row.at(x), below.at(x), is_first, is_last, is_beside_edge);
            found.median[y * tile_size + x] = median;
            found.largest[y * tile_size + x] = largest;
        };
        for (std::size_t x = 0; x < tile_size; ++x)
            find(x, false);
        find(0, true);
        find(tile.width - 1, true);
    }
    return found;
}

} // namespace pt
