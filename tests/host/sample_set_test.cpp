// Sets of sample indices against sets of single numbers.
#include "lib/film/sample_set.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>

namespace {

using pt::SampleRange;
using pt::SampleSet;

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
            ASSERT_EQ(set.overlap(range).has_value(), missing < range.count());
            if (missing == range.count()) {
                set.add(range);
                for (std::uint64_t j = range.first; j < range.end; ++j)
                    expected.insert(j);
            } else if (missing == 0) {
                set.remove(range);
                for (std::uint64_t j = range.first; j < range.end; ++j)
                    expected.erase(j);
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

// As range by range.
TEST(SampleSet, SetsAreAddedToSets) {
    std::mt19937 random(2);
    for (int round = 0; round < 1000; ++round) {
        SampleSet a;
        SampleSet b;
        SampleSet expected;
        for (std::uint64_t index = random() % 3; index < 40;) {
            const SampleRange range{index, index + 1 + random() % 4};
            if (const auto to = random() % 3; to > 0) {
                (to == 1 ? a : b).add(range);
                expected.add(range);
            }
            index = range.end + random() % 2;
        }
        ASSERT_FALSE(a.overlap(b)) << pt::text_of(a) << " and " << pt::text_of(b);
        const SampleSet before = a;
        a.add(b);
        ASSERT_EQ(a, expected);
        for (const SampleRange &range : b.ranges()) {
            ASSERT_FALSE(before.overlap(range));
            ASSERT_EQ(a.overlap(SampleSet({range.end - 1, range.end + 1}))->first, range.end - 1);
        }
        ASSERT_EQ(a.overlap(b).has_value(), !b.empty());
    }
}

TEST(SampleSet, ReachesToTheLastIndex) {
    SampleSet set({0, pt::sample_index_end});
    EXPECT_EQ(set.count(), std::uint64_t{1} << 32);
    EXPECT_TRUE(set.next_missing(5).empty());
    set.remove({7, 8});
    EXPECT_EQ(set.next_missing(0), (SampleRange{7, 8}));
    EXPECT_EQ(pt::text_of(set), "[0, 7), [8, 4294967296)");
}

} // namespace
