#include "lib/film/neighbourhoods.h"

#include "shaders/neighbourhood.h"

#include <algorithm>

namespace pt {

namespace {

using gpu::more_of;

// For each pixel of a row, the values to its left, in it and to its right, sorted. Missing ones come first.
struct SortedRow {
    std::array<float, region_size> low;
    std::array<float, region_size> middle;
    std::array<float, region_size> high;

    gpu::Sorted at(std::size_t x) const { return {low[x], middle[x], high[x]}; }
};

void sort_row(const PixelPlane &region, std::size_t y, SortedRow &to) {
    std::array<float, region_size + 2> row{};
    row[0] = gpu::BELOW_ALL;
    std::copy_n(region.values + y * region.stride, region.width, row.begin() + 1);
    row[region.width + 1] = gpu::BELOW_ALL;
    for (std::size_t x = 0; x < region_size; ++x) {
        const auto [low, middle, high] = gpu::sorted(row[x], row[x + 1], row[x + 2]);
        to.low[x] = low;
        to.middle[x] = middle;
        to.high[x] = high;
    }
}

// For a region of a single row or column.
void find_in_line(const PixelPlane &line, Neighbourhoods &to) {
    const bool is_row = line.height == 1;
    const std::size_t count = is_row ? line.width : line.height;
    const auto value = [&](std::size_t i) { return line.values[is_row ? i : i * line.stride]; };
    for (std::size_t i = 0; i < count; ++i) {
        const auto [median, largest] = gpu::neighbourhood_in_line(i > 0 ? value(i - 1) : gpu::BELOW_ALL, value(i),
                                                                  i + 1 < count ? value(i + 1) : gpu::BELOW_ALL);
        const std::size_t place = is_row ? i : i * region_size;
        to.median[place] = median;
        to.largest[place] = largest;
    }
}

} // namespace

// Row by row, so that each row is sorted once.
void find_neighbourhoods(const PixelPlane &region, Neighbourhoods &to) {
    if (region.width == 1 || region.height == 1) {
        find_in_line(region, to);
        return;
    }
    std::array<SortedRow, 3> rows{};
    sort_row(region, 0, rows[0]);
    for (std::size_t y = 0; y < region.height; ++y) {
        const SortedRow &above = rows[(y + 2) % 3];
        const SortedRow &row = rows[y % 3];
        SortedRow &below = rows[(y + 1) % 3];
        const bool is_first = y == 0;
        const bool is_last = y + 1 == region.height;
        if (!is_last)
            sort_row(region, y + 1, below);
        const auto find = [&](std::size_t x, bool is_beside_edge) {
            const auto [median, largest] =
                gpu::neighbourhood(above.at(x), row.at(x), below.at(x), is_first, is_last, is_beside_edge);
            to.median[y * region_size + x] = median;
            to.largest[y * region_size + x] = largest;
        };
        for (std::size_t x = 0; x < region_size; ++x)
            find(x, false);
        find(0, true);
        find(region.width - 1, true);
    }
}

// By columns first: what touches a pixel is three neighbouring columns of three pixels.
std::array<float, tile_size * tile_size> largest_in_tile(const PixelPlane &tile) {
    std::array<std::array<float, tile_size + 2>, tile_size + 2> values{}; // with those beyond the edges
    for (std::size_t y = 0; y < tile.height; ++y)
        std::copy_n(tile.values + y * tile.stride, tile.width, values[y + 1].begin() + 1);
    std::array<float, tile_size * tile_size> largest;
    for (std::size_t y = 0; y < tile_size; ++y) {
        std::array<float, tile_size + 2> column;
        for (std::size_t x = 0; x < tile_size + 2; ++x)
            column[x] = more_of(more_of(values[y][x], values[y + 1][x]), values[y + 2][x]);
        for (std::size_t x = 0; x < tile_size; ++x)
            largest[y * tile_size + x] = more_of(more_of(column[x], column[x + 1]), column[x + 2]);
    }
    return largest;
}

} // namespace pt
