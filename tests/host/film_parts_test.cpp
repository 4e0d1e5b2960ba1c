// Which samples the two parts of a film hold.
#include "lib/film/film_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
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

// The definition, by trying all indices.
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

// Samples of a film as sets, one for each part in memory.
struct FilmOfSets {
    pt::PartUse use;
    std::array<SampleSet, 2> parts;

    // hull: of the samples of all films. What Kernel overwrites holds nothing.
    void add(const SampleRange &samples, const SampleRange &hull) {
        SampleRange before = use.hull();
        if (use.needs_fold(hull)) {
            parts[0].add(parts[1]);
            parts[1] = {};
        }
        use.extend(hull);
        for (const SampleRange &piece :
             {SampleRange{samples.first, std::clamp(use.split(), samples.first, samples.end)},
              SampleRange{std::clamp(use.split(), samples.first, samples.end), samples.end}}) {
            if (piece.empty())
                continue;
            SampleSet &part = parts[use.part_of(piece.first)];
            EXPECT_TRUE(!pt::begins_part(before, use.split(), piece.first) || part.empty()) << pt::text_of(piece);
            part.add(piece);
            before = pt::hull_of(before, piece);
        }
    }

    // What DeviceFilm::read gives.
    std::array<SampleSet, 2> split_at(std::uint64_t split) const {
        std::array<SampleSet, 2> sets{parts[use.older()], parts[1 - use.older()]};
        if (use.empty() || use.split() == split)
            return sets;
        const bool older = use.split() < split;
        sets[older ? 0 : 1].add(sets[older ? 1 : 0]);
        sets[older ? 1 : 0] = {};
        return sets;
    }
};

// Two films take ranges in any order, each at once, as Kernel does, or cut into runs, as tiles do. In the end both
// parts hold just the samples on their side of the split, whichever film took them.
TEST(FilmParts, SamplesAddedInAnyOrderEndOnTheirSideOfTheSplit) {
    std::mt19937 random(1);
    for (int round = 0; round < 3000; ++round) {
        SampleSet all;
        std::array<FilmOfSets, 2> films;
        const std::uint64_t base = round % 2 == 0 ? 0 : random() % 5000;
        for (int i = 0; i < 12; ++i) {
            const std::uint64_t from = base + random() % 400;
            const SampleRange missing = all.next_missing(from);
            const SampleRange range{missing.first, std::min(missing.end, missing.first + 1 + random() % 80)};
            FilmOfSets &film = films[random() % 2];
            for (std::uint64_t sample = range.first; sample < range.end;) {
                const std::uint64_t end_of_run = pt::end_of_run(all.hull(), sample);
                const std::uint64_t end = round % 4 < 2 ? range.end : std::min(range.end, end_of_run);
                ASSERT_GT(end, sample);
                film.add({sample, end}, pt::hull_of(all.hull(), {sample, end}));
                all.add({sample, end});
                sample = end;
            }
            const std::uint64_t split = pt::split_of(all.hull());
            for (const FilmOfSets &part : films) {
                const auto [older, newer] = part.split_at(split);
                ASSERT_TRUE(older.empty() || older.hull().end <= split) << pt::text_of(all);
                ASSERT_TRUE(newer.empty() || newer.hull().first >= split) << pt::text_of(all);
            }
        }
    }
}

// Between a sample and the end given for it, neither the part changes nor the split; at the end one does.
TEST(FilmParts, ARunEndsWhereTheNextSampleGoesElsewhere) {
    const auto goes_to = [](const SampleRange &hull, std::uint64_t sample) {
        const std::uint64_t split = pt::split_of(pt::hull_of(hull, {sample, sample + 1}));
        return std::pair(split, sample < split);
    };
    for (const std::uint64_t first : {0U, 3U, 40U, 63U, 64U, 1000U})
        for (std::uint64_t sample = first; sample < first + 600; ++sample) {
            const SampleRange before{first, sample};
            const std::uint64_t end = pt::end_of_run(before, sample);
            ASSERT_GT(end, sample);
            for (std::uint64_t other = sample; other < end; ++other)
                ASSERT_EQ(goes_to({first, other}, other), goes_to(before, sample)) << first << ": " << sample;
            ASSERT_NE(goes_to({first, end}, end), goes_to(before, sample)) << first << ": " << sample;
        }
}

} // namespace
