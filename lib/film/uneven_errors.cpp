#include "lib/film/uneven_errors.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace pt {

namespace {

template <typename Function>
void for_each_tile(const TileGrid &grid, const Rectangle &pixels, const Function &function) {
    for (std::uint32_t y = pixels.y; y < pixels.y + pixels.height; y += gpu::TILE_SIZE)
        for (std::uint32_t x = pixels.x; x < pixels.x + pixels.width; x += gpu::TILE_SIZE)
            function(grid.tile_at(x, y));
}

bool has_changed(const TileSamples &samples, const TileSamples &before, const Rectangle &pixels) {
    bool changed = false;
    for_each_tile(samples.grid(), pixels, [&](std::size_t tile) { changed |= samples.of(tile) != before.of(tile); });
    return changed;
}

} // namespace

template <typename Fact, typename LookAt>
void UnevenErrors::update(Known<Fact> &known, std::uint32_t side, const TileSamples &samples, const LookAt &look_at) {
    const TileGrid &grid = samples.grid();
    const std::size_t columns = (grid.width + side - 1) / side;
    const bool is_known = !known.facts.empty() && known.samples.grid() == grid;
    if (!is_known) {
        known.samples = {}; // until all of it has been looked at
        known.facts.assign(columns * ((grid.height + side - 1) / side), {});
    }
    for (std::uint32_t y = 0; y < grid.height; y += side)
        for (std::uint32_t x = 0; x < grid.width; x += side) {
            const Rectangle pixels{x, y, std::min(side, grid.width - x), std::min(side, grid.height - y)};
            if (!is_known || has_changed(samples, known.samples, pixels))
                known.facts[y / side * columns + x / side] = look_at(pixels);
        }
    known.samples = samples;
}

// A row of tiles is read once one of them has changed.
void UnevenErrors::estimate(const TileSamples &samples, double unit, const ReadRows &read) {
    const std::size_t value_count = std::size_t{3} * samples.grid().width * samples.grid().height;
    for (auto *const values : {&radiance_, &standard_error_, &lesser_})
        values->resize(value_count);
    PixelSums rows;
    std::optional<std::uint32_t> first_row;
    update(rejected_, gpu::TILE_SIZE, samples, [&](const Rectangle &tile) {
        if (first_row != tile.y) {
            rows.resize(std::size_t{samples.grid().width} * tile.height);
            read(tile.y, rows);
        }
        first_row = tile.y;
        return estimate_tile(tile, samples.grid(), unit, rows);
    });
}

std::uint64_t UnevenErrors::estimate_tile(const Rectangle &tile, const TileGrid &grid, double unit,
                                          const PixelSums &rows) {
    const std::size_t width = grid.width;
    const std::size_t first = tile.y * width + tile.x;
    return rows.estimate({tile.x, tile.width, tile.height, width}, unit,
                         {&radiance_[first], &standard_error_[first], &lesser_[first], width * grid.height, width});
}

RegionPixels UnevenErrors::pixels_of(const TileSamples &samples, const Rectangle &pixels) const {
    const TileGrid &grid = samples.grid();
    const std::size_t width = grid.width;
    const std::size_t first = pixels.y * width + pixels.x;
    RegionPixels region{{pixels.width, pixels.height, width, width * grid.height, &radiance_[first],
                         &standard_error_[first], &lesser_[first]},
                        0,
                        {}};
    std::size_t place = 0;
    for_each_tile(samples.grid(), pixels, [&](std::size_t tile) {
        region.rejected += rejected_.facts[tile];
        region.sample_counts[place++] = static_cast<double>(samples.of(tile).count());
    });
    return region;
}

std::span<const double> UnevenErrors::tile_squares(const TileSamples &samples, double unit, const ReadRows &read) {
    estimate(samples, unit, read);
    update(squares_, gpu::TILE_SIZE, samples,
           [&](const Rectangle &tile) { return own_square_of(pixels_of(samples, tile)); });
    return squares_.facts;
}

std::span<const RegionErrors> UnevenErrors::regions(const TileSamples &samples, double unit, const ReadRows &read) {
    estimate(samples, unit, read);
    update(regions_, gpu::REGION_SIZE, samples,
           [&](const Rectangle &region) { return region_errors(pixels_of(samples, region)); });
    return regions_.facts;
}

void UnevenErrors::forget() noexcept {
    rejected_.facts.clear();
    squares_.facts.clear();
    regions_.facts.clear();
}

} // namespace pt
