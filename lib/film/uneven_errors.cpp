#include "lib/film/uneven_errors.h"

#include <algorithm>

namespace pt {

namespace {

template <typename Function>
void for_each_tile(const TileGrid &grid, const Rectangle &pixels, const Function &function) {
    for (std::uint32_t y = pixels.y; y < pixels.y + pixels.height; y += gpu::TILE_SIZE)
        for (std::uint32_t x = pixels.x; x < pixels.x + pixels.width; x += gpu::TILE_SIZE)
            function(grid.tile_at(x, y));
}

// The squares of a band of rows, from left to right.
std::vector<Rectangle> squares_of_band(const TileGrid &grid, std::uint32_t side, std::uint32_t top) {
    std::vector<Rectangle> squares;
    for (std::uint32_t left = 0; left < grid.width; left += side)
        squares.push_back({left, top, std::min(side, grid.width - left), std::min(side, grid.height - top)});
    return squares;
}

bool has_changed(const TileSamples &samples, const TileSamples &before, const Rectangle &pixels) {
    bool changed = false;
    for_each_tile(samples.grid(), pixels, [&](std::size_t tile) { changed |= samples.of(tile) != before.of(tile); });
    return changed;
}

// rows: those of the film that the pixels lie in, in their whole length.
RegionPixels pixels_of(const TileSamples &samples, double unit, const Rectangle &pixels, const PixelSums &rows) {
    PixelSums sums;
    sums.resize(pixels.pixel_count());
    for (std::size_t y = 0; y < pixels.height; ++y)
        sums.copy(rows, y * samples.grid().width + pixels.x, pixels.width, y * pixels.width);
    RegionPixels region{pixels.width, pixels.height, sums.estimates(unit, true), {}};
    for_each_tile(samples.grid(), pixels, [&](std::size_t tile) {
        region.sample_counts.push_back(static_cast<double>(samples.of(tile).count()));
    });
    return region;
}

} // namespace

template <typename Fact, typename LookAt>
void UnevenErrors::update(Known<Fact> &known, std::uint32_t side, const TileSamples &samples, const ReadRows &read,
                          const LookAt &look_at) {
    const TileGrid &grid = samples.grid();
    const std::size_t columns = (grid.width + side - 1) / side;
    const bool is_known = !known.facts.empty() && known.samples.grid() == grid;
    if (!is_known)
        known.facts.assign(columns * ((grid.height + side - 1) / side), {});
    for (std::uint32_t top = 0; top < grid.height; top += side) {
        std::vector<Rectangle> changed = squares_of_band(grid, side, top);
        if (is_known)
            std::erase_if(changed,
                          [&](const Rectangle &pixels) { return !has_changed(samples, known.samples, pixels); });
        if (changed.empty())
            continue;
        const PixelSums rows = read(top, changed.front().height);
        for (const Rectangle &pixels : changed)
            known.facts[top / side * columns + pixels.x / side] = look_at(pixels, rows);
    }
    known.samples = samples;
}

std::span<const double> UnevenErrors::tile_squares(const TileSamples &samples, double unit, const ReadRows &read) {
    update(squares_, gpu::TILE_SIZE, samples, read, [&](const Rectangle &tile, const PixelSums &rows) {
        return own_square_of(pixels_of(samples, unit, tile, rows));
    });
    return squares_.facts;
}

std::span<const RegionErrors> UnevenErrors::regions(const TileSamples &samples, double unit, const ReadRows &read) {
    update(regions_, gpu::REGION_SIZE, samples, read, [&](const Rectangle &region, const PixelSums &rows) {
        return region_errors(pixels_of(samples, unit, region, rows));
    });
    return regions_.facts;
}

void UnevenErrors::forget() noexcept {
    squares_.facts.clear();
    regions_.facts.clear();
}

} // namespace pt
