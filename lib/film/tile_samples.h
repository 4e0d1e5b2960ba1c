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
    TileSamples() = default;
    explicit TileSamples(const TileGrid &grid, SampleSet all = {}) : grid_(grid), sets_{std::move(all)} {}

    const TileGrid &grid() const { return grid_; }

    bool even() const { return set_of_.empty(); }
    const SampleSet &of(std::size_t tile) const { return even() ? sets_.front() : sets_[set_of_[tile]]; }

    // No two sets are equal. Unused sets may remain.
    const std::vector<SampleSet> &sets() const { return sets_; }
    std::uint32_t set_of(std::size_t tile) const { return even() ? 0 : set_of_[tile]; }

    bool empty() const;
    std::uint64_t least() const;
    std::uint64_t most() const;
    std::uint64_t total() const;

    // The tiles must be in ascending order and must not have these samples yet.
    void add(std::span<const std::uint32_t> tiles, const SampleRange &range);
    void set(std::size_t tile, const SampleSet &samples);

    // first_row must be a multiple of the tile size.
    TileSamples rows(std::uint32_t first_row, std::uint32_t row_count) const;

    void clear() noexcept;

    // Drops unused sets. If all tiles have the same set, also drops the list of tiles.
    void tidy();

private:
    std::uint32_t index_of(SampleSet samples);
    void tell_apart();

    TileGrid grid_;
    std::vector<SampleSet> sets_{SampleSet()};
    std::vector<std::uint32_t> set_of_; // index in sets_ by tile; empty if all tiles have sets_[0]
};

} // namespace pt
