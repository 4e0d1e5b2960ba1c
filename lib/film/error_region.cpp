#include "lib/film/error_region.h"

#include "lib/film/min_max.h"
#include "lib/film/value_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace pt {

namespace {

constexpr std::size_t channel_count = 3;

// The square of the pixel's limit that divides the square of its error must not come from a bright sample that made
// that error, so it is no more than the squares of what is known without it: the darker part's mean, what most
// neighbours show, and the mean about it; but no more than that of the pixel's own mean either.
//
// Where that is the own mean after all, since it is bright around, but a part with half of the samples or more knows
// little of it, the pixel lies at an edge: a share p of its samples is bright, M each, and one of N was so far, hence
// the mean T = M / N and a square error of about T^2. If any p was as likely before, it is y / N with the density y
// e^-y now, and the limit is M p. The expectation of T^2 / (M^2 p^2 + k^2), with k^2 what the darker part knows and the
// offset, is the integral of y e^-y / (y^2 + k^2 / T^2): ln(T / k), less a constant of about 1 that depends on what was
// likely before; without it the stated error was right in the scenes that it was calibrated with.
struct Limit {
    double square;       // with the offset
    double known;        // square of the mean of the darker part, with the offset
    double light_beyond; // > 0: the pixel is at an edge, and the logarithm counts
    double alone;        // > 0: the pixel stands out from what is about it
};

constexpr double e_squared = 7.39; // where the logarithm of an edge passes 1, and a pixel begins to stand out

Limit limit_of(double standard_error, double mean, double lesser, double around) {
    const double square = less_of(squared(mean), squared(more_of(lesser, around))) + relative_offset;
    const double known = squared(lesser) + relative_offset;
    // With a share f of the samples in the darker part, standard_error / (mean - lesser) = sqrt(f / (1 - f)),
    // which is 1 for halves, but for the roundings of the three to float.
    const double most_are_dark = standard_error >= 0.99 * (mean - lesser) ? 1.0 : 0.0;
    const double bright_around = around >= mean ? 1.0 : 0.0;
    const double alone = squared(mean) + relative_offset - e_squared * (squared(around) + relative_offset);
    return {square, known, most_are_dark * bright_around * (square - e_squared * known), alone};
}

// A pixel that stands out is a lamp or a highlight of about its size, which many of its samples meet, or a rare bright
// sample. Nearly all of its light in one part of the film: it was met once, and nothing in the pixel tells which.
// In both parts: it was met again (error_estimate.cpp compares how many are the one and the other).
bool is_met_once(double standard_error, double mean, double lesser) {
    return lesser <= 0.02 * mean && standard_error >= 0.99 * (mean - lesser);
}

bool is_met_again(double mean, double lesser) {
    return lesser >= 0.25 * mean;
}

// Light of the mean M in a pixel beside may be in a share p of this one's samples too. None of N had it if their mean
// is below M / N. With any p up to 1 / N as likely, and the square error p M^2 / N, the expectation of
// p M^2 / N / (T^2 + p^2 M^2 + offset) is the integral over p from 0 to 1 / N, times the chance of about 1 / N that p
// is that small: ln((T^2 + M^2 / N^2 + offset) / (T^2 + offset)) / 2N.
double unseen_square(double mean, double largest_beside, double sample_count) {
    const double brightest = largest_beside / sample_count;
    if (mean >= brightest)
        return 0.0;
    return 0.5 / sample_count * std::log1p(squared(brightest) / (squared(mean) + relative_offset));
}

// > 0 wherever there is any.
double brighter_beside(double mean, double largest_beside, double sample_count) {
    return largest_beside * (1.0 + 0x1p-40) - mean * sample_count;
}

// Numbers of a row of a tile.
using TileRow = std::array<double, tile_size>;

// Those beyond the edge of an image are 0.
void take(TileRow &to, const float *from, std::size_t count) {
    if (count < tile_size) {
        to.fill(0.0);
        std::copy_n(from, count, to.begin());
        return;
    }
    for (std::size_t i = 0; i < tile_size; ++i)
        to[i] = static_cast<double>(from[i]);
}

struct RowValues {
    TileRow mean;
    TileRow standard_error;
    TileRow lesser;

    RowValues(const RegionValues &region, std::size_t channel, std::size_t x, std::size_t y) {
        const std::size_t first = channel * region.plane_stride + y * region.row_stride + x;
        const std::size_t count = std::min(tile_size, region.width - x);
        take(mean, region.mean + first, count);
        take(standard_error, region.standard_error + first, count);
        take(lesser, region.lesser + first, count);
    }
};

struct RowErrors {
    TileRow relative_square;
    TileRow unseen;
    bool has_alone = false; // what follows is 0 where there are none
    TileRow met_once{};
    TileRow as_lamps{};
    TileRow met_again{};
};

// The largest of a row's numbers.
double largest_of(const TileRow &row) {
    static_assert(tile_size == 8);
    std::array<double, 4> largest;
    for (std::size_t i = 0; i < 4; ++i)
        largest[i] = more_of(row[i], row[i + 4]);
    return more_of(more_of(largest[0], largest[1]), more_of(largest[2], largest[3]));
}

// Few values need a logarithm, or stand out.
void find_row_errors(const RowValues &row, const TileRow &around, const float *largest_beside, double sample_count,
                     RowErrors &to) {
    TileRow special; // > 0 where one is
    for (std::size_t i = 0; i < tile_size; ++i) {
        const Limit limit = limit_of(row.standard_error[i], row.mean[i], row.lesser[i], around[i]);
        const double beside = brighter_beside(row.mean[i], static_cast<double>(largest_beside[i]), sample_count);
        to.relative_square[i] = squared(row.standard_error[i]) / limit.square;
        to.unseen[i] = 0.0;
        special[i] = more_of(more_of(limit.light_beyond, limit.alone), beside);
    }
    if (!(largest_of(special) > 0.0))
        return;
    for (std::size_t i = 0; i < tile_size; ++i) {
        if (!(special[i] > 0.0))
            continue;
        const Limit limit = limit_of(row.standard_error[i], row.mean[i], row.lesser[i], around[i]);
        if (limit.light_beyond > 0.0)
            to.relative_square[i] *= 0.5 * std::log(limit.square / limit.known);
        if (limit.alone > 0.0 && is_met_once(row.standard_error[i], row.mean[i], row.lesser[i])) {
            to.has_alone = true;
            to.met_once[i] = to.relative_square[i];
            to.as_lamps[i] = squared(row.standard_error[i]) / (squared(row.mean[i]) + relative_offset);
            to.relative_square[i] = 0.0;
        } else if (limit.alone > 0.0 && is_met_again(row.mean[i], row.lesser[i])) {
            to.has_alone = true;
            to.met_again[i] = 1.0;
        }
        to.unseen[i] = unseen_square(row.mean[i], static_cast<double>(largest_beside[i]), sample_count);
    }
}

// The mean about each pixel, of its tile or, where one pixel of that has most of the light, of its region.
void find_levels(const TileRow &mean, ValueSet tile, ValueSet region, TileRow &level) {
    TileRow lacking; // > 0 where the tile does not tell
    for (std::size_t i = 0; i < tile_size; ++i) {
        level[i] = tile.mean_besides_and_without_largest(mean[i]);
        lacking[i] = 0.5 * tile.mean_besides(mean[i]) - level[i];
    }
    if (!(largest_of(lacking) > 0.0))
        return;
    for (std::size_t i = 0; i < tile_size; ++i)
        level[i] = lacking[i] > 0.0 ? region.mean_besides_and_without_largest(mean[i]) : level[i];
}

// The means of the channels.
using ValueSets = std::array<ValueSet, channel_count>;

struct SetsOfRegion {
    ValueSets region;
    std::array<ValueSets, (region_size / tile_size) * (region_size / tile_size)> tiles; // row by row
};

std::size_t tile_columns(const RegionValues &region) {
    return (region.width + tile_size - 1) / tile_size;
}

// The channels side by side, since each sum waits for the one before.
SetsOfRegion sets_of(const RegionValues &region) {
    SetsOfRegion sets;
    std::array<double, channel_count> sums{};
    const std::size_t columns = tile_columns(region);
    for (std::size_t top = 0; top < region.height; top += tile_size)
        for (std::size_t y = top; y < std::min(top + tile_size, region.height); ++y)
            for (std::size_t left = 0; left < region.width; left += tile_size) {
                ValueSets &of_tile = sets.tiles[top / tile_size * columns + left / tile_size];
                ValueSets tile = of_tile;
                const std::size_t right = std::min(left + tile_size, region.width);
                for (std::size_t x = left; x < right; ++x)
                    for (std::size_t channel = 0; channel < channel_count; ++channel) {
                        const float *const plane = region.mean + channel * region.plane_stride;
                        const auto mean = static_cast<double>(plane[y * region.row_stride + x]);
                        tile[channel].add(mean);
                        sums[channel] += mean;
                    }
                of_tile = tile;
            }
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        sets.region[channel] = ValueSet(sums[channel], region.width * region.height);
        for (std::size_t top = 0; top < region.height; top += tile_size)
            for (std::size_t left = 0; left < region.width; left += tile_size) {
                ValueSet &tile = sets.tiles[top / tile_size * columns + left / tile_size][channel];
                tile.set_count(std::min(tile_size, region.width - left) * std::min(tile_size, region.height - top));
                sets.region[channel].add_largest_of(tile);
            }
    }
    return sets;
}

PixelPlane means_of(const RegionValues &region, std::size_t channel) {
    return {region.width, region.height, region.row_stride, region.mean + channel * region.plane_stride};
}

} // namespace

void find_pixel_errors(const RegionValues &region, std::span<const double> sample_counts, PixelErrors &to) {
    const std::size_t columns = tile_columns(region);
    const SetsOfRegion sets = sets_of(region);
    for (auto *const numbers : {&to.square, &to.relative_square, &to.met_once, &to.as_lamps, &to.met_again, &to.unseen})
        numbers->fill(0.0);
    Neighbourhoods near{};
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        find_neighbourhoods(means_of(region, channel), near);
        for (std::size_t y = 0; y < region.height; ++y)
            for (std::size_t column = 0; column < columns; ++column) {
                const std::size_t tile = y / tile_size * columns + column;
                const std::size_t first = y * region_size + column * tile_size;
                const RowValues row(region, channel, column * tile_size, y);
                TileRow around;
                find_levels(row.mean, sets.tiles[tile][channel], sets.region[channel], around);
                for (std::size_t i = 0; i < tile_size; ++i)
                    around[i] = more_of(static_cast<double>(near.median[first + i]), around[i]);
                RowErrors errors;
                find_row_errors(row, around, &near.largest[first], sample_counts[tile], errors);
                for (std::size_t i = 0; i < tile_size; ++i) {
                    to.square[first + i] += squared(row.standard_error[i]);
                    to.relative_square[first + i] += errors.relative_square[i];
                    to.unseen[first + i] += errors.unseen[i];
                }
                for (std::size_t i = 0; errors.has_alone && i < tile_size; ++i) {
                    to.met_once[first + i] += errors.met_once[i];
                    to.as_lamps[first + i] += errors.as_lamps[i];
                    to.met_again[first + i] += errors.met_again[i];
                }
            }
    }
}

double own_square(const RegionValues &tile, double sample_count) {
    const SetsOfRegion sets = sets_of(tile);
    std::array<std::array<TileRow, channel_count>, tile_size> errors; // by row
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        const ValueSet &values = sets.tiles.front()[channel];
        const auto largest = largest_in_tile(means_of(tile, channel));
        for (std::size_t y = 0; y < tile.height; ++y) {
            const RowValues row(tile, channel, 0, y);
            TileRow around;
            for (std::size_t i = 0; i < tile_size; ++i)
                around[i] = values.mean_besides_and_without_largest(row.mean[i]);
            RowErrors of_row;
            find_row_errors(row, around, &largest[y * tile_size], sample_count, of_row);
            for (std::size_t i = 0; i < tile_size; ++i)
                errors[y][channel][i] = of_row.relative_square[i] + of_row.as_lamps[i] + of_row.unseen[i];
        }
    }
    std::array<double, channel_count> sums{};
    for (std::size_t y = 0; y < tile.height; ++y)
        for (std::size_t x = 0; x < tile.width; ++x)
            for (std::size_t channel = 0; channel < channel_count; ++channel)
                sums[channel] += errors[y][channel][x];
    return sums[0] + sums[1] + sums[2];
}

} // namespace pt
