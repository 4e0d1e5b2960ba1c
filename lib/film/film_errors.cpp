#include "lib/film/film_errors.h"

#include <cstddef>

namespace pt {

namespace {

// rows: rows of the film that begin with the first row of the tile.
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

// A row of tiles is read only if one of them has changed.
std::span<const TileErrors> FilmErrors::of(const TileSamples &samples, double unit, const ReadRows &read) {
    const TileGrid &grid = samples.grid();
    const bool is_known = !tiles_.empty() && samples_.grid() == grid;
    if (!is_known) {
        samples_ = {}; // until all of it has been looked at
        tiles_.assign(grid.count(), {});
    }
    PixelSums rows;
    std::uint32_t end = 0; // of the rows that have been read
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
