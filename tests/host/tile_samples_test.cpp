// Which samples tiles hold, against a list of sets.
#include "lib/film/tile_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace {

using pt::SampleRange;
using pt::SampleSet;
using pt::TileGrid;
using pt::TileSamples;

constexpr TileGrid small_grid{21, 10}; // three tiles beside each other, two one below the other

TEST(TileGrid, EdgesHaveSmallerTiles) {
    EXPECT_EQ(small_grid.columns(), 3U);
    EXPECT_EQ(small_grid.count(), 6U);
    EXPECT_EQ(small_grid.pixels(0), (pt::Rectangle{0, 0, 8, 8}));
    EXPECT_EQ(small_grid.pixels(5), (pt::Rectangle{16, 8, 5, 2}));
    std::uint64_t pixels = 0;
    for (std::size_t tile = 0; tile < small_grid.count(); ++tile) {
        const pt::Rectangle at = small_grid.pixels(tile);
        EXPECT_EQ(small_grid.tile_at(at.x, at.y), tile);
        EXPECT_EQ(small_grid.tile_at(at.x + at.width - 1, at.y + at.height - 1), tile);
        pixels += at.pixel_count();
    }
    EXPECT_EQ(pixels, 210U);
}

TEST(TileSamples, CountWhatTilesHold) {
    TileSamples samples(small_grid);
    EXPECT_TRUE(samples.even());
    EXPECT_TRUE(samples.empty());
    const std::vector<std::uint32_t> all{0, 1, 2, 3, 4, 5};
    samples.add(all, {0, 16});
    EXPECT_TRUE(samples.even());
    EXPECT_EQ(samples.total(), 16U * 210U);
    samples.add(std::vector<std::uint32_t>{5}, {16, 32});
    EXPECT_FALSE(samples.even());
    EXPECT_EQ(samples.least(), 16U);
    EXPECT_EQ(samples.most(), 32U);
    EXPECT_EQ(samples.total(), 16U * 210U + 16U * 10U);
    EXPECT_EQ(samples.hull(), (SampleRange{0, 32}));
    EXPECT_EQ(samples.of(4), SampleSet({0, 16}));
    EXPECT_EQ(samples.of(5), SampleSet({0, 32}));
    samples.clear();
    EXPECT_TRUE(samples.even());
    EXPECT_TRUE(samples.empty());
}

// Ranges are added to random tiles; at times all tiles come to hold the same.
TEST(TileSamples, AreThoseThatWereAddedToEach) {
    std::mt19937 generator(18);
    TileSamples samples(small_grid);
    std::vector<SampleSet> expected(small_grid.count());
    for (int step = 0; step < 200; ++step) {
        std::vector<std::uint32_t> tiles;
        const std::uint64_t first = generator() % 20 * 8;
        for (std::uint32_t tile = 0; tile < small_grid.count(); ++tile)
            if (generator() % 3 != 0 && !expected[tile].overlap(SampleRange{first, first + 8}))
                tiles.push_back(tile);
        samples.add(tiles, {first, first + 8});
        for (const std::uint32_t tile : tiles)
            expected[tile].add({first, first + 8});
        if (step % 5 == 0)
            samples.tidy();
        std::uint64_t total = 0;
        for (std::size_t tile = 0; tile < small_grid.count(); ++tile) {
            ASSERT_EQ(samples.of(tile), expected[tile]) << step;
            total += expected[tile].count() * small_grid.pixels(tile).pixel_count();
        }
        ASSERT_EQ(samples.total(), total);
    }
    samples.tidy();
    EXPECT_TRUE(samples.even()) << "after 200 steps all ranges are everywhere";
    EXPECT_EQ(samples.sets().size(), 1U);
}

TEST(TileSamples, RowsOfTilesAreAFilmOfTheirOwn) {
    TileSamples samples(small_grid);
    samples.add(std::vector<std::uint32_t>{0, 4}, {0, 16});
    const TileSamples lower = samples.rows(8, 2);
    EXPECT_EQ(lower.grid(), (TileGrid{21, 2}));
    EXPECT_TRUE(lower.of(0).empty());
    EXPECT_EQ(lower.of(1), SampleSet({0, 16}));
    EXPECT_EQ(lower.total(), 16U * 16U);
}

} // namespace
