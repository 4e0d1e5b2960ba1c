#include "lib/film/uneven_errors.h"

#include <algorithm>

namespace pt {

namespace {

constexpr auto side = static_cast<std::uint32_t>(region_size);

template <typename Function>
void for_each_tile(const TileGrid &grid, const Rectangle &region, const Function &function) {
    for (std::uint32_t y = region.y; y < region.y + region.height; y += gpu::TILE_SIZE)
        for (std::uint32_t x = region.x; x < region.x + region.width; x += gpu::TILE_SIZE)
            function(grid.tile_at(x, y));
}

// The regions of a band of rows, from left to right.
std::vector<Rectangle> regions_of_band(const TileGrid &grid, std::uint32_t top) {
    std::vector<Rectangle> regions;
    for (std::uint32_t left = 0; left < grid.width; left += side)
        regions.push_back({left, top, std::min(side, grid.width - left), std::min(side, grid.height - top)});
    return regions;
}

} // namespace

bool UnevenErrors::has_changed(const TileSamples &samples, const Rectangle &region) const {
    bool changed = false;
    for_each_tile(samples.grid(), region, [&](std::size_t tile) { changed |= samples.of(tile) != samples_.of(tile); });
    return changed;
}

RegionErrors UnevenErrors::look_at(const TileSamples &samples, double unit, const Rectangle &region,
                                   const PixelSums &rows) {
    PixelSums sums;
    sums.resize(region.pixel_count());
    for (std::size_t y = 0; y < region.height; ++y)
        sums.copy(rows, y * samples.grid().width + region.x, region.width, y * region.width);
    RegionPixels pixels{region.width, region.height, sums.estimates(unit, true), {}};
    for_each_tile(samples.grid(), region, [&](std::size_t tile) {
        pixels.sample_counts.push_back(static_cast<double>(samples.of(tile).count()));
    });
    std::vector<double> own_squares;
    const RegionErrors errors = region_errors(pixels, &own_squares);
    auto own_square = own_squares.begin();
    for_each_tile(samples.grid(), region, [&](std::size_t tile) { tile_squares_[tile] = *own_square++; });
    return errors;
}

void UnevenErrors::update(const TileSamples &samples, double unit, const ReadRows &read) {
    const TileGrid &grid = samples.grid();
    const std::uint32_t columns = (grid.width + side - 1) / side;
    const bool is_known = !regions_.empty() && samples_.grid() == grid;
    if (!is_known) {
        regions_.assign(std::size_t{columns} * ((grid.height + side - 1) / side), {});
        tile_squares_.assign(grid.count(), 0.0);
    }
    for (std::uint32_t top = 0; top < grid.height; top += side) {
        std::vector<Rectangle> changed = regions_of_band(grid, top);
        if (is_known)
            std::erase_if(changed, [&](const Rectangle &region) { return !has_changed(samples, region); });
        if (changed.empty())
            continue;
        const PixelSums rows = read(top, changed.front().height);
        for (const Rectangle &region : changed)
            regions_[std::size_t{top / side} * columns + region.x / side] = look_at(samples, unit, region, rows);
    }
    samples_ = samples;
}

} // namespace pt
