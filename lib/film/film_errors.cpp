#include "lib/film/film_errors.h"

#include <cstddef>

namespace pt {

namespace {

// rows: rows of the film that begin with the first row of the tile.
TileErrors errors_of(const Rectangle &pixels, const SampleSet &samples, double unit, std::uint32_t film_width,
                     const PixelSums &rows) {
    TileValues tile{
        .width = pixels.width, .height = pixels.height, .sample_count = static_cast<double>(samples.count())};
    tile.rejected = rows.estimate({pixels.x, pixels.width, pixels.height, film_width}, unit,
                                  {tile.mean.front().data(), tile.standard_error.front().data(),
                                   tile.lesser.front().data(), tile_size * tile_size, tile_size});
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
