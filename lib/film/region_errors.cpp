#include "lib/film/region_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace pt {

namespace {

using gpu::more_of;

constexpr std::size_t channel_count = 3;

// Positive wherever light may be unseen.
double brighter_beside(double mean, double largest_beside, double sample_count) {
    return largest_beside * (1.0 + 0x1p-40) - mean * sample_count;
}

// Numbers of a row of a tile.
using TileRow = std::array<double, tile_size>;

// Pixels beyond the edge of the image count as 0.
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

// Only few values need a logarithm or stand out; the others are handled without branches.
void find_row_errors(const RowValues &row, const TileRow &around, const float *largest_beside, double sample_count,
                     RowErrors &to) {
    TileRow special; // > 0 where one is
    const auto limit_of = [&](std::size_t i) {
        return gpu::limit_of(row.standard_error[i], row.mean[i], row.lesser[i], around[i], relative_offset);
    };
    for (std::size_t i = 0; i < tile_size; ++i) {
        const gpu::Limit limit = limit_of(i);
        const double beside = brighter_beside(row.mean[i], static_cast<double>(largest_beside[i]), sample_count);
        to.relative_square[i] = gpu::square_of_quotient(row.standard_error[i], limit.square);
        to.unseen[i] = 0.0;
        special[i] = more_of(more_of(limit.light_beyond, limit.alone), beside);
    }
    if (!(largest_of(special) > 0.0))
        return;
    for (std::size_t i = 0; i < tile_size; ++i) {
        if (!(special[i] > 0.0))
            continue;
        const gpu::Limit limit = limit_of(i);
        to.relative_square[i] = gpu::relative_square(row.standard_error[i], limit);
        if (limit.alone > 0.0 && gpu::is_met_once(row.standard_error[i], row.mean[i], row.lesser[i])) {
            to.has_alone = true;
            to.met_once[i] = to.relative_square[i];
            to.as_lamps[i] = gpu::square_as_lamp(row.standard_error[i], row.mean[i], relative_offset);
            to.relative_square[i] = 0.0;
        } else if (limit.alone > 0.0 && gpu::is_met_again(row.mean[i], row.lesser[i])) {
            to.has_alone = true;
            to.met_again[i] = 1.0;
        }
        to.unseen[i] =
            gpu::unseen_square(row.mean[i], static_cast<double>(largest_beside[i]), sample_count, relative_offset);
    }
}

// The mean around each pixel (gpu::level_about). Only few tiles cannot tell.
void find_levels(const TileRow &mean, const gpu::ValueSet &tile, const gpu::ValueSet &region, TileRow &level) {
    TileRow lacking;
    for (std::size_t i = 0; i < tile_size; ++i) {
        level[i] = gpu::mean_besides_and_without_largest(tile, mean[i]);
        lacking[i] = gpu::lacking_level(tile, mean[i], level[i]);
    }
    if (!(largest_of(lacking) > 0.0))
        return;
    for (std::size_t i = 0; i < tile_size; ++i)
        level[i] = gpu::level_about(mean[i], tile, region);
}

// One set of means for each channel.
using ValueSets = std::array<gpu::ValueSet, channel_count>;

struct SetsOfRegion {
    ValueSets region;
    std::array<ValueSets, (region_size / tile_size) * (region_size / tile_size)> tiles; // row by row
};

std::size_t tile_columns(const RegionValues &region) {
    return (region.width + tile_size - 1) / tile_size;
}

// The channels are summed side by side, because each sum has to wait for its previous addition.
SetsOfRegion sets_of(const RegionValues &region) {
    SetsOfRegion sets{};
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
                        tile[channel] = gpu::with_value(tile[channel], mean);
                        sums[channel] += mean;
                    }
                of_tile = tile;
            }
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        gpu::ValueSet &all = sets.region[channel];
        for (const ValueSets &tile : sets.tiles)
            all = gpu::united(all, tile[channel]);
        all.sum = sums[channel]; // in the order of the pixels
    }
    return sets;
}

PixelPlane means_of(const RegionValues &region, std::size_t channel) {
    return {region.width, region.height, region.row_stride, region.mean + channel * region.plane_stride};
}

void add_tile(ErrorSquares &to, double square, double value_count) {
    to.sum += square;
    to.of_tiles += squared(square);
    to.times_tile_sizes += square * value_count;
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
        const gpu::ValueSet &values = sets.tiles.front()[channel];
        const auto largest = largest_in_tile(means_of(tile, channel));
        for (std::size_t y = 0; y < tile.height; ++y) {
            const RowValues row(tile, channel, 0, y);
            TileRow around;
            for (std::size_t i = 0; i < tile_size; ++i)
                around[i] = gpu::mean_besides_and_without_largest(values, row.mean[i]);
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

RegionErrors region_errors(const RegionPixels &region) {
    const std::size_t width = region.values.width;
    const std::size_t height = region.values.height;
    PixelErrors pixels;
    find_pixel_errors(region.values, region.sample_counts, pixels);
    RegionErrors errors;
    errors.rejected = region.rejected;
    for (std::size_t top = 0; top < height; top += tile_size)
        for (std::size_t first = 0; first < width; first += tile_size) {
            const std::size_t bottom = std::min(top + tile_size, height);
            const std::size_t last = std::min(first + tile_size, width);
            const auto value_count = static_cast<double>(3 * (bottom - top) * (last - first));
            const auto add = [&](ErrorSquares &to, const PixelErrors::Numbers &of) {
                double sum = 0.0;
                for (std::size_t y = top; y < bottom; ++y)
                    for (std::size_t x = first; x < last; ++x) {
                        const double square = of[y * region_size + x];
                        sum += square;
                        to.of_pixels += squared(square);
                    }
                add_tile(to, sum, value_count);
            };
            add(errors.square, pixels.square);
            add(errors.relative_square, pixels.relative_square);
            add(errors.met_once, pixels.met_once);
            add(errors.as_lamps, pixels.as_lamps);
            for (std::size_t y = top; y < bottom; ++y)
                for (std::size_t x = first; x < last; ++x) {
                    errors.met_again += pixels.met_again[y * region_size + x];
                    errors.unseen += pixels.unseen[y * region_size + x];
                }
            errors.value_count += value_count;
            errors.squares_of_tile_sizes += squared(value_count);
        }
    return errors;
}

double own_square_of(const RegionPixels &tile) {
    return own_square(tile.values, tile.sample_counts.front());
}

} // namespace pt
