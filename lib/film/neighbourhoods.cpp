#include "lib/film/neighbourhoods.h"

#include "lib/film/min_max.h"

#include <algorithm>
#include <limits>

namespace pt {

namespace {

// Where a region ends, a value that is missing beside a pixel lies below or above all.
constexpr float below_all = -1.0F;
constexpr float above_all = std::numeric_limits<float>::infinity();

// Three values in ascending order.
struct Sorted {
    float low;
    float middle;
    float high;
};

Sorted sorted(float a, float b, float c) {
    const float low = less_of(a, b);
    const float high = more_of(a, b);
    return {less_of(low, c), more_of(low, less_of(high, c)), more_of(high, c)};
}

// Of nine values in three rows, each sorted: the median is the middle one of the largest of the low values, the middle
// one of the middle values and the smallest of the high values (Paeth 1990, Median finding on a 3 x 3 grid).
float median_of_rows(const Sorted &a, const Sorted &b, const Sorted &c) {
    return sorted(more_of(more_of(a.low, b.low), c.low), sorted(a.middle, b.middle, c.middle).middle,
                  less_of(less_of(a.high, b.high), c.high))
        .middle;
}

// About each pixel of a row: the values left of it, in it and right of it; those missing come first.
struct SortedRow {
    std::array<float, region_size> low;
    std::array<float, region_size> middle;
    std::array<float, region_size> high;
    std::array<float, region_size> largest; // of those not missing

    Sorted at(std::size_t x) const { return {low[x], middle[x], high[x]}; }
};

void sort_row(const PixelPlane &region, std::size_t y, SortedRow &to) {
    std::array<float, region_size + 2> row{};
    row[0] = below_all;
    std::copy_n(region.values + y * region.stride, region.width, row.begin() + 1);
    row[region.width + 1] = below_all;
    for (std::size_t x = 0; x < region_size; ++x) {
        const auto [low, middle, high] = sorted(row[x], row[x + 1], row[x + 2]);
        to.low[x] = low;
        to.middle[x] = middle;
        to.high[x] = high;
        to.largest[x] = high;
    }
}

// The lower of two in the middle is wanted, that is of k values the one with (k - 1) / 2 below it, which is the fifth
// of nine if 4 - (k - 1) / 2 of those missing lie below all, and the others above: of the three missing beside an edge
// two lie below, and of the five about a corner three. The row beyond the first and the last, for pixels that are not
// in a corner:
SortedRow missing_row() {
    SortedRow row;
    row.low.fill(below_all);
    row.middle.fill(below_all);
    row.high.fill(above_all);
    row.largest.fill(0.0F);
    return row;
}

// The same values where the one that is missing comes last.
Sorted with_missing_above(const Sorted &row) {
    return {row.middle, row.high, above_all};
}

// Of a pixel in the first or last column, of two or more.
float median_beside_edge(const SortedRow &above, const SortedRow &row, const SortedRow &below, std::size_t x,
                         bool is_first_row, bool is_last_row) {
    constexpr Sorted missing{below_all, below_all, below_all};
    const Sorted own = row.at(x);
    if (is_first_row)
        return median_of_rows(missing, with_missing_above(own), with_missing_above(below.at(x)));
    if (is_last_row)
        return median_of_rows(with_missing_above(above.at(x)), with_missing_above(own), missing);
    return median_of_rows(above.at(x), own, with_missing_above(below.at(x)));
}

// Of a single row or column, where one or two pixels touch a pixel, or none.
void find_in_line(const PixelPlane &line, Neighbourhoods &to) {
    const bool is_row = line.height == 1;
    const std::size_t count = is_row ? line.width : line.height;
    const auto value = [&](std::size_t i) { return line.values[is_row ? i : i * line.stride]; };
    for (std::size_t i = 0; i < count; ++i) {
        const auto [low, middle, high] =
            sorted(i > 0 ? value(i - 1) : below_all, value(i), i + 1 < count ? value(i + 1) : below_all);
        const std::size_t place = is_row ? i : i * region_size;
        to.median[place] = more_of(middle, 0.0F);
        to.largest[place] = high;
    }
}

} // namespace

// Row by row, each of which is sorted once.
void find_neighbourhoods(const PixelPlane &region, Neighbourhoods &to) {
    if (region.width == 1 || region.height == 1) {
        find_in_line(region, to);
        return;
    }
    std::array<SortedRow, 3> rows;
    rows[2] = missing_row();
    sort_row(region, 0, rows[0]);
    for (std::size_t y = 0; y < region.height; ++y) {
        const SortedRow &above = rows[(y + 2) % 3];
        const SortedRow &row = rows[y % 3];
        SortedRow &below = rows[(y + 1) % 3];
        const bool is_last = y + 1 == region.height;
        if (is_last)
            below = missing_row();
        else
            sort_row(region, y + 1, below);
        float *const medians = &to.median[y * region_size];
        float *const largest = &to.largest[y * region_size];
        for (std::size_t x = 0; x < region_size; ++x) {
            medians[x] = median_of_rows(above.at(x), row.at(x), below.at(x));
            largest[x] = more_of(more_of(above.largest[x], row.largest[x]), below.largest[x]);
        }
        for (const std::size_t x : {std::size_t{0}, region.width - 1})
            medians[x] = median_beside_edge(above, row, below, x, y == 0, is_last);
    }
}

// By columns first: what touches a pixel is three of those in a row.
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
