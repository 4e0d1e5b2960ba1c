#include "lib/film/tile_errors.h"

#include "shaders/neighbourhood.h"

#include <array>
#include <numeric>

namespace pt {

namespace {

constexpr std::size_t channel_count = 3;

// The expected squared errors of TileErrors in gpu_layout.h, by pixel, summed over channels. Pixels outside the image
// have 0.
struct PixelErrors {
    using Numbers = std::array<double, tile_size * tile_size>;

    Numbers square{};
    Numbers relative_square{};
    Numbers met_once{};
    Numbers as_lamps{};
    Numbers met_again{};
    Numbers unseen{};
};

// Each pixel with its left and right neighbor, sorted. Missing neighbors come first.
using SortedRow = std::array<gpu::Sorted, tile_size>;

SortedRow sorted_row(const TileValues &tile, std::size_t channel, std::size_t y) {
    const auto mean = [&](std::size_t x) { return tile.pixels[y * tile_size + x][channel].mean; };
    SortedRow row;
    for (std::size_t x = 0; x < tile.width; ++x)
        row[x] = gpu::sorted(x > 0 ? mean(x - 1) : gpu::BELOW_ALL, mean(x),
                             x + 1 < tile.width ? mean(x + 1) : gpu::BELOW_ALL);
    return row;
}

gpu::Neighbourhood neighbourhood_at(const std::array<SortedRow, tile_size> &rows, const TileValues &tile, std::size_t x,
                                    std::size_t y) {
    const bool is_first = y == 0;
    const bool is_last = y + 1 == tile.height;
    const gpu::Sorted &above = rows[is_first ? y : y - 1][x];
    const gpu::Sorted &below = rows[is_last ? y : y + 1][x];
    if (tile.height == 1)
        return gpu::neighbourhood_in_line(rows[y][x]);
    if (tile.width == 1)
        return gpu::neighbourhood_in_line(gpu::column_of(above, rows[y][x], below, is_first, is_last));
    return gpu::neighbourhood(above, rows[y][x], below, is_first, is_last, x == 0 || x + 1 == tile.width);
}

void add_value(const TileValues &tile, std::size_t channel, std::size_t pixel, const gpu::Neighbourhood &near,
               const gpu::ValueSet &means, PixelErrors &errors) {
    const PixelValue &value = tile.pixels[pixel][channel];
    const auto mean = static_cast<double>(value.mean);
    const auto standard_error = static_cast<double>(value.standard_error);
    const auto lesser = static_cast<double>(value.lesser);
    const auto largest_beside = static_cast<double>(near.largest);
    const double around = gpu::around(mean, means, static_cast<double>(near.median), largest_beside);
    const gpu::Limit limit = gpu::limit_of(standard_error, mean, lesser, around, relative_offset);
    errors.square[pixel] += squared(standard_error);
    const double relative_square = gpu::relative_square(standard_error, limit);
    if (limit.alone > 0.0 && gpu::is_met_once(standard_error, mean, lesser)) {
        errors.met_once[pixel] += relative_square;
        errors.as_lamps[pixel] += gpu::square_as_lamp(standard_error, mean, relative_offset);
    } else {
        errors.relative_square[pixel] += relative_square;
        errors.met_again[pixel] += limit.alone > 0.0 && gpu::is_met_again(mean, lesser) ? 1.0 : 0.0;
    }
    errors.unseen[pixel] += gpu::unseen_square(mean, largest_beside, tile.sample_count, relative_offset);
}

PixelErrors pixel_errors(const TileValues &tile) {
    PixelErrors errors;
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        std::array<SortedRow, tile_size> rows;
        gpu::ValueSet means{};
        for (std::size_t y = 0; y < tile.height; ++y) {
            rows[y] = sorted_row(tile, channel, y);
            for (std::size_t x = 0; x < tile.width; ++x)
                means = gpu::with_value(means, static_cast<double>(tile.pixels[y * tile_size + x][channel].mean));
        }
        for (std::size_t y = 0; y < tile.height; ++y)
            for (std::size_t x = 0; x < tile.width; ++x)
                add_value(tile, channel, y * tile_size + x, neighbourhood_at(rows, tile, x, y), means, errors);
    }
    return errors;
}

} // namespace

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

namespace {

TileErrors errors_of(const Rectangle &pixels, const SampleSet &samples, double unit, std::uint32_t film_width,
                     const PixelSums &rows) {
    TileValues tile{
        .width = pixels.width, .height = pixels.height, .sample_count = static_cast<double>(samples.count())};
    PixelValues values(rows, unit);
    for (std::size_t y = 0; y < pixels.height; ++y)
        for (std::size_t x = 0; x < pixels.width; ++x) {
            const std::size_t pixel = y * film_width + pixels.x + x;
            tile.pixels[y * tile_size + x] = values.of(pixel);
            for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part)
                tile.rejected += rows.plane(part, gpu::FILM_REJECTED)[pixel];
        }
    return tile_errors(tile);
}

} // namespace

std::span<const TileErrors> FilmErrors::of(const TileSamples &samples, double unit, const ReadRows &read) {
    const TileGrid &grid = samples.grid();
    const bool is_known = !tiles_.empty() && samples_.grid() == grid;
    if (!is_known) {
        samples_ = {}; // is still empty if read() throws
        tiles_.assign(grid.count(), {});
    }
    PixelSums rows;
    std::uint32_t end = 0;
    for (std::size_t tile = 0; tile < grid.count(); ++tile) {
        if (is_known && samples.of(tile) == samples_.of(tile))
            continue;
        const Rectangle pixels = grid.pixels(tile);
        if (pixels.y >= end) {
            rows.resize(std::size_t{grid.width} * pixels.height);
            read(pixels.y, rows);
            end = pixels.y + pixels.height;
        }
        tiles_[tile] = errors_of(pixels, samples.of(tile), unit, grid.width, rows);
    }
    samples_ = samples;
    return tiles_;
}

} // namespace pt
