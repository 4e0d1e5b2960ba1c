#include "lib/film/film_errors.h"

#include <algorithm>
#include <array>
#include <cstddef>

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

// What the samples of a rectangle, which is at most a region, show.
class Estimates {
public:
    // rows: rows of the film that begin with the first row of the rectangle.
    RegionPixels of(const Rectangle &pixels, const TileSamples &samples, double unit, const PixelSums &rows) {
        const std::uint64_t rejected =
            rows.estimate({pixels.x, pixels.width, pixels.height, samples.grid().width}, unit,
                          {mean_.data(), standard_error_.data(), lesser_.data(), plane, region_size});
        RegionPixels region{
            {pixels.width, pixels.height, region_size, plane, mean_.data(), standard_error_.data(), lesser_.data()},
            rejected,
            {}};
        std::size_t place = 0;
        for_each_tile(samples.grid(), pixels, [&](std::size_t tile) {
            region.sample_counts[place++] = static_cast<double>(samples.of(tile).count());
        });
        return region;
    }

private:
    static constexpr std::size_t plane = region_size * region_size;

    std::array<float, 3 * plane> mean_;
    std::array<float, 3 * plane> standard_error_;
    std::array<float, 3 * plane> lesser_;
};

} // namespace

// A row of rectangles is read only if one of them has changed.
template <typename Fact>
void FilmErrors::update(Known<Fact> &known, std::uint32_t side, const TileSamples &samples, double unit,
                        const ReadRows &read, Fact (*fact_of)(const RegionPixels &)) {
    const TileGrid &grid = samples.grid();
    const std::size_t columns = (grid.width + side - 1) / side;
    const bool is_known = !known.facts.empty() && known.samples.grid() == grid;
    if (!is_known) {
        known.samples = {}; // until all of it has been looked at
        known.facts.assign(columns * ((grid.height + side - 1) / side), {});
    }
    PixelSums rows;
    Estimates estimates;
    for (std::uint32_t y = 0; y < grid.height; y += side) {
        const std::uint32_t height = std::min(side, grid.height - y);
        bool is_read = false;
        for (std::uint32_t x = 0; x < grid.width; x += side) {
            const Rectangle pixels{x, y, std::min(side, grid.width - x), height};
            if (is_known && !has_changed(samples, known.samples, pixels))
                continue;
            if (!is_read) {
                rows.resize(std::size_t{grid.width} * height);
                read(y, rows);
                is_read = true;
            }
            known.facts[y / side * columns + x / side] = fact_of(estimates.of(pixels, samples, unit, rows));
        }
    }
    known.samples = samples;
}

std::span<const double> FilmErrors::tile_squares(const TileSamples &samples, double unit, const ReadRows &read) {
    update(squares_, gpu::TILE_SIZE, samples, unit, read, &own_square_of);
    return squares_.facts;
}

std::span<const RegionErrors> FilmErrors::regions(const TileSamples &samples, double unit, const ReadRows &read) {
    update(regions_, gpu::REGION_SIZE, samples, unit, read, &region_errors);
    return regions_.facts;
}

void FilmErrors::forget() noexcept {
    squares_.facts.clear();
    regions_.facts.clear();
}

} // namespace pt
