// Which samples each tile of a film holds. Many tiles have the same samples, so each different set is kept once.
#pragma once

#include "lib/film/sample_set.h"
#include "lib/film/tile_grid.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pt {

class TileSamples {
public:
    // No samples.
    TileSamples() = default;
    explicit TileSamples(const TileGrid &grid, SampleSet all = {}) : grid_(grid), sets_{std::move(all)} {}

    const TileGrid &grid() const { return grid_; }

    // Whether all tiles hold the same samples, which are those of any tile.
    bool even() const { return set_of_.empty(); }
    const SampleSet &of(std::size_t tile) const { return even() ? sets_.front() : sets_[set_of_[tile]]; }

    // The different sets, and which of them a tile has. Sets that no tile has any more may be among them.
    const std::vector<SampleSet> &sets() const { return sets_; }
    std::uint32_t set_of(std::size_t tile) const { return even() ? 0 : set_of_[tile]; }

    // Of all tiles.
    bool empty() const;
    std::uint64_t least() const; // samples of a pixel
    std::uint64_t most() const;
    std::uint64_t total() const; // of all pixels together

    // The samples that are added must not be there yet; tiles are in ascending order.
    void add(std::span<const std::uint32_t> tiles, const SampleRange &range);
    void set(std::size_t tile, const SampleSet &samples);

    // The samples of consecutive rows of pixels, which begin with a row of tiles.
    TileSamples rows(std::uint32_t first_row, std::uint32_t row_count) const;

    // Takes no memory.
    void clear() noexcept;

    // Forgets sets that no tile has and, if all tiles have the same set, the list of tiles.
    void tidy();

private:
    std::uint32_t index_of(SampleSet samples);
    void tell_apart();

    TileGrid grid_;
    std::vector<SampleSet> sets_{SampleSet()};
    std::vector<std::uint32_t> set_of_; // by tile; empty: all have the first
};

} // namespace pt
