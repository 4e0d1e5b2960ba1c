#include "lib/film/sample_set.h"

#include "lib/kernel/tile_slice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace {

using pt::PartCounts;
using pt::SampleRange;
using pt::SampleSet;

PartCounts counts_of_first(std::uint64_t count) {
    return pt::part_counts(SampleSet({0, count}));
}

TEST(FilmParts, TheOlderPartHasThePowerOfTwoBelow) {
    EXPECT_EQ(pt::part_counts({}), (PartCounts{0, 0}));
    EXPECT_EQ(counts_of_first(1), (PartCounts{1, 0}));
    EXPECT_EQ(counts_of_first(8), (PartCounts{8, 0}));
    EXPECT_EQ(counts_of_first(9), (PartCounts{8, 1}));
    EXPECT_EQ(counts_of_first(16), (PartCounts{8, 8}));
    EXPECT_EQ(counts_of_first(17), (PartCounts{16, 1}));
    EXPECT_EQ(counts_of_first(1U << 31), (PartCounts{1U << 30, 1U << 30}));
    EXPECT_EQ(counts_of_first(UINT32_MAX), (PartCounts{1U << 31, (1U << 31) - 1}));
}

std::uint64_t split_by_definition(const SampleRange &hull) {
    std::uint64_t best = 0;
    for (std::uint64_t index = hull.first + 1; index < hull.end; ++index)
        if (index % 8 == 0 && (best == 0 || std::countr_zero(index) > std::countr_zero(best)))
            best = index;
    return best > 0 ? best : (hull.end + 7) / 8 * 8;
}

TEST(FilmParts, TheSplitHasTheMostZerosAtItsEnd) {
    for (std::uint64_t first = 0; first < 150; ++first)
        for (std::uint64_t end = first + 1; end < 300; ++end)
            ASSERT_EQ(pt::split_of({first, end}), split_by_definition({first, end})) << first << ", " << end;
}

TEST(FilmParts, SamplesAddedInAnyOrderEndOnTheirSideOfTheSplit) {
    std::mt19937 random(1);
    for (int round = 0; round < 3000; ++round) {
        SampleSet all;
        std::array<std::array<SampleSet, 2>, 2> films;
        const std::uint64_t base = round % 2 == 0 ? 0 : random() % 5000;
        for (int i = 0; i < 12; ++i) {
            const SampleRange missing = all.next_missing(base + random() % 400);
            const SampleRange range{missing.first, std::min(missing.end, missing.first + 1 + random() % 80)};
            SampleRange before = all.empty() ? SampleRange{} : all.hull();
            const pt::TileSlice slice{{}, before, range, true};
            const std::uint64_t split = slice.split();
            if (slice.moves_split())
                for (auto &parts : films) {
                    const std::size_t kept = pt::split_of(before) < split ? pt::older_part : pt::newer_part;
                    parts[kept].add(parts[1 - kept]);
                    parts[1 - kept] = {};
                }
            for (const SampleRange &piece : {SampleRange{range.first, std::clamp(split, range.first, range.end)},
                                             SampleRange{std::clamp(split, range.first, range.end), range.end}}) {
                if (piece.empty())
                    continue;
                const std::size_t part = piece.first < split ? pt::older_part : pt::newer_part;
                const bool is_empty = films[0][part].empty() && films[1][part].empty();
                ASSERT_TRUE(!pt::begins_part(before, split, piece.first) || is_empty) << pt::text_of(piece);
                films[random() % 2][part].add(piece);
                before = pt::hull_of(before, piece);
            }
            all.add(range);
            ASSERT_EQ(split, pt::split_of(all.hull()));
            for (const auto &[older, newer] : films) {
                ASSERT_TRUE(older.empty() || older.hull().end <= split) << pt::text_of(all);
                ASSERT_TRUE(newer.empty() || newer.hull().first >= split) << pt::text_of(all);
            }
        }
    }
}

} // namespace
