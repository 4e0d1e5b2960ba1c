// The samples that tiles take: in any order and cut in any way, everything that they lack and nothing twice.
#include "lib/render/tile_tasks.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace {

// Tiles with samples of their own reach goals of their own, and others stay as they are. A task never leaves some of
// its tiles behind the others for more than a sample.
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
                    ASSERT_TRUE(samples.of(tile) == samples.of(first) && !samples.of(tile).overlap(slice.samples));
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
}

TEST(TileTasks, OfAllTilesAreThoseOfEach) {
    std::vector<std::uint32_t> all(7);
    std::iota(all.begin(), all.end(), 0U);
    const pt::TileSamples samples({56, 8}, pt::SampleSet({4, 9}));
    const pt::Schedule schedule({1.0, 64.0 * 3, 1000});
    pt::TileTasks together(samples.of(0), 0, all, 8);
    pt::TileTasks each(samples, 0, all, [](std::uint32_t) { return 8; });
    for (; !together.empty(); together.leave_behind(1), each.leave_behind(1)) {
        const pt::TileSlice a = together.next(schedule);
        const pt::TileSlice b = each.next(schedule);
        EXPECT_EQ(a.tiles.front(), b.tiles.front());
        EXPECT_TRUE(a.samples == b.samples && a.before == b.before && a.tiles.size() == b.tiles.size());
    }
    EXPECT_TRUE(each.empty());
    EXPECT_TRUE(pt::TileTasks(samples.of(0), 0, all, 5).empty()) << "they have as many";
}

} // namespace
