#include "lib/film/sample_set.h"
#include "lib/film/tile_samples.h"
#include "lib/render/tile_tasks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

namespace {

using pt::SampleRange;
using pt::SampleSet;
using pt::TileGrid;
using pt::TileSamples;

constexpr std::uint64_t universe = 60;

std::set<std::uint64_t> members(const SampleSet &set) {
    std::set<std::uint64_t> all;
    for (const SampleRange &range : set.ranges())
        for (std::uint64_t i = range.first; i < range.end; ++i)
            all.insert(i);
    return all;
}

TEST(SampleSet, IsTheSetOfItsIndices) {
    std::mt19937 random(1);
    for (int round = 0; round < 2000; ++round) {
        SampleSet set;
        std::set<std::uint64_t> expected;
        for (int i = 0; i < 12; ++i) {
            const std::uint64_t first = random() % universe;
            const SampleRange range{first, first + random() % 8};
            std::uint64_t missing = 0;
            for (std::uint64_t j = range.first; j < range.end; ++j)
                missing += expected.contains(j) ? 0 : 1;
            ASSERT_EQ(set.overlap(SampleSet(range)).has_value(), missing < range.count());
            if (missing == range.count()) {
                set.add(range);
                for (std::uint64_t j = range.first; j < range.end; ++j)
                    expected.insert(j);
            }
            ASSERT_EQ(members(set), expected);
            ASSERT_EQ(set.count(), expected.size());
            for (std::size_t k = 1; k < set.ranges().size(); ++k)
                ASSERT_LT(set.ranges()[k - 1].end, set.ranges()[k].first) << "adjacent ranges are one";
            const std::uint64_t from = random() % universe;
            std::uint64_t below = 0;
            for (const std::uint64_t index : expected)
                below += index < from ? 1 : 0;
            ASSERT_EQ(set.count_below(from), below);
            const SampleRange next = set.next_missing(from);
            ASSERT_FALSE(expected.contains(next.first));
            for (std::uint64_t j = from; j < next.first; ++j)
                ASSERT_TRUE(expected.contains(j));
            ASSERT_TRUE(next.end == pt::sample_index_end || expected.contains(next.end));
        }
    }
}

TEST(SampleSet, ReachesToTheLastIndex) {
    EXPECT_EQ(SampleSet({0, pt::sample_index_end}).count(), std::uint64_t{1} << 32);
    SampleSet set({0, 7});
    set.add({8, pt::sample_index_end});
    EXPECT_EQ(set.next_missing(0), (SampleRange{7, 8}));
    EXPECT_EQ(pt::text_of(set), "[0, 7), [8, 4294967296)");
}

std::uint64_t split_by_definition(const SampleRange &hull) {
    std::uint64_t best = 0;
    for (std::uint64_t index = hull.first + 1; index < hull.end; ++index)
        if (index % 8 == 0 && (best == 0 || std::countr_zero(index) > std::countr_zero(best)))
            best = index;
    return best > 0 ? best : (hull.end + 7) / 8 * 8;
}

TEST(SampleSet, ItsSplitHasTheMostZerosAtItsEnd) {
    for (std::uint64_t first = 0; first < 150; ++first)
        for (std::uint64_t end = first + 1; end < 300; ++end)
            ASSERT_EQ(pt::split_of({first, end}), split_by_definition({first, end})) << first << ", " << end;
}

constexpr TileGrid small_grid{21, 10};

TEST(TileSamples, AreThoseThatWereAddedToEach) {
    std::mt19937 generator(18);
    TileSamples samples(small_grid);
    std::vector<SampleSet> expected(small_grid.count());
    for (int step = 0; step < 200; ++step) {
        std::vector<std::uint32_t> tiles;
        const std::uint64_t first = generator() % 20 * 8;
        for (std::uint32_t tile = 0; tile < small_grid.count(); ++tile)
            if (generator() % 3 != 0 && !expected[tile].overlap(SampleSet({first, first + 8})))
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
        const auto [least, most] = std::ranges::minmax(expected, {}, &SampleSet::count);
        ASSERT_EQ(samples.least(), least.count());
        ASSERT_EQ(samples.most(), most.count());
    }
    samples.tidy();
    EXPECT_TRUE(samples.even()) << "after 200 steps all ranges are everywhere";
    EXPECT_EQ(samples.sets().size(), 1U);
    samples.clear();
    EXPECT_TRUE(samples.even() && samples.empty());
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

TEST(TileTasks, BringTilesToTheirGoals) {
    std::mt19937 random(1);
    for (int round = 0; round < 200; ++round) {
        const pt::TileGrid grid{8 * (1 + static_cast<std::uint32_t>(random() % 9)), 40};
        pt::TileSamples samples(grid);
        for (std::uint32_t tile = 0; tile < grid.count(); ++tile)
            if (random() % 3 > 0) {
                const std::uint64_t first = 10 * (random() % 3);
                samples.set(tile, pt::SampleSet({first, first + 1 + random() % 2 * 7}));
            }
        std::vector<std::uint32_t> tiles;
        std::vector<std::uint64_t> goals;
        for (std::uint32_t tile = 0; tile < grid.count(); ++tile) {
            goals.push_back(samples.of(tile).count() + random() % 3 * 17);
            if (random() % 4 > 0)
                tiles.push_back(tile);
        }
        const pt::TileSamples before = samples;
        pt::Schedule schedule({1.0, 64.0 * static_cast<double>(1 + random() % 100), 1000});
        const auto goal = [&](std::uint32_t tile) { return goals[tile]; };
        for (pt::TileTasks tasks(samples, 3, tiles, goal); !tasks.empty(); tasks = {samples, 3, tiles, goal})
            while (!tasks.empty()) {
                const pt::TileSlice slice = tasks.next(schedule);
                const std::uint32_t first = slice.tiles.front();
                for (const std::uint32_t tile : slice.tiles)
                    ASSERT_TRUE(samples.of(tile) == samples.of(first) &&
                                !samples.of(tile).overlap(SampleSet(slice.samples)));
                EXPECT_EQ(slice.before, samples.of(first).empty() ? pt::SampleRange{} : samples.of(first).hull());
                samples.add(slice.tiles, slice.samples);
                const bool ends = tasks.ends_samples(slice.tiles.size());
                const bool ends_all = tasks.ends_all(slice.tiles.size());
                EXPECT_TRUE(ends || slice.samples.count() == 1);
                tasks.leave_behind(slice.tiles.size());
                EXPECT_EQ(tasks.is_within_samples(), !ends);
                EXPECT_EQ(tasks.empty(), ends_all);
            }
        std::vector<bool> takes(grid.count());
        for (const std::uint32_t tile : tiles)
            takes[tile] = true;
        for (std::uint32_t tile = 0; tile < grid.count(); ++tile) {
            EXPECT_EQ(samples.of(tile).count(), takes[tile] ? goals[tile] : before.of(tile).count());
            EXPECT_EQ(samples.of(tile).count_below(3), before.of(tile).count_below(3)) << "from sample 3 on";
        }
    }
    EXPECT_TRUE(pt::TileTasks(pt::SampleSet({4, 9}), 0, {}, 5).empty()) << "all tiles have as many";
}

} // namespace
