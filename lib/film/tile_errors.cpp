#include "lib/film/tile_errors.h"

#include <array>
#include <cmath>
#include <numeric>

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

TileRow row_of(const TileFloats &values, std::size_t first) {
    TileRow row;
    for (std::size_t i = 0; i < tile_size; ++i)
        row[i] = static_cast<double>(values[first + i]);
    return row;
}

struct RowValues {
    TileRow mean;
    TileRow standard_error;
    TileRow lesser;

    RowValues(const TileValues &tile, std::size_t channel, std::size_t first) :
        mean(row_of(tile.mean[channel], first)),
        standard_error(row_of(tile.standard_error[channel], first)),
        lesser(row_of(tile.lesser[channel], first)) {}
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

// The means of each channel. They are summed side by side, because each sum has to wait for its previous addition.
std::array<gpu::ValueSet, channel_count> means_of(const TileValues &tile) {
    std::array<gpu::ValueSet, channel_count> sets{};
    for (std::size_t y = 0; y < tile.height; ++y)
        for (std::size_t x = 0; x < tile.width; ++x)
            for (std::size_t channel = 0; channel < channel_count; ++channel)
                sets[channel] =
                    gpu::with_value(sets[channel], static_cast<double>(tile.mean[channel][y * tile_size + x]));
    return sets;
}

} // namespace

PixelErrors pixel_errors(const TileValues &tile) {
    PixelErrors errors;
    const auto means = means_of(tile);
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        const Neighbourhoods near = find_neighbourhoods({tile.width, tile.height, tile.mean[channel].data()});
        for (std::size_t first = 0; first < tile.height * tile_size; first += tile_size) {
            const RowValues row(tile, channel, first);
            TileRow around;
            for (std::size_t i = 0; i < tile_size; ++i)
                around[i] = gpu::around(row.mean[i], means[channel], static_cast<double>(near.median[first + i]),
                                        static_cast<double>(near.largest[first + i]));
            RowErrors of_row;
            find_row_errors(row, around, &near.largest[first], tile.sample_count, of_row);
            for (std::size_t i = 0; i < tile.width; ++i) {
                errors.square[first + i] += squared(row.standard_error[i]);
                errors.relative_square[first + i] += of_row.relative_square[i];
                errors.unseen[first + i] += of_row.unseen[i];
            }
            for (std::size_t i = 0; of_row.has_alone && i < tile.width; ++i) {
                errors.met_once[first + i] += of_row.met_once[i];
                errors.as_lamps[first + i] += of_row.as_lamps[i];
                errors.met_again[first + i] += of_row.met_again[i];
            }
        }
    }
    return errors;
}

TileErrors tile_errors(const TileValues &tile) {
    const PixelErrors pixels = pixel_errors(tile);
    const auto value_count = static_cast<double>(channel_count * tile.width * tile.height);
    const auto squares_of = [&](const PixelErrors::Numbers &of) {
        ErrorSquares squares;
        for (const double square : of) {
            squares.sum += square;
            squares.of_pixels += squared(square);
        }
        squares.of_tiles = squared(squares.sum);
        squares.times_tile_sizes = squares.sum * value_count;
        return squares;
    };
    return {.value_count = value_count,
            .squares_of_tile_sizes = squared(value_count),
            .square = squares_of(pixels.square),
            .relative_square = squares_of(pixels.relative_square),
            .met_once = squares_of(pixels.met_once),
            .as_lamps = squares_of(pixels.as_lamps),
            .met_again = std::accumulate(pixels.met_again.begin(), pixels.met_again.end(), 0.0),
            .unseen = std::accumulate(pixels.unseen.begin(), pixels.unseen.end(), 0.0),
            .rejected = tile.rejected};
}

} // namespace pt
