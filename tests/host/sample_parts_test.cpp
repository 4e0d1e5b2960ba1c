// Which samples the two parts of the film hold.
#include "lib/film/sample_parts.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

namespace {

using pt::PartCounts;

TEST(SampleParts, TheOlderPartHasThePowerOfTwoBelow) {
    EXPECT_EQ(pt::part_counts(0), (PartCounts{0, 0}));
    EXPECT_EQ(pt::part_counts(1), (PartCounts{1, 0}));
    EXPECT_EQ(pt::part_counts(8), (PartCounts{8, 0}));
    EXPECT_EQ(pt::part_counts(9), (PartCounts{8, 1}));
    EXPECT_EQ(pt::part_counts(16), (PartCounts{8, 8}));
    EXPECT_EQ(pt::part_counts(17), (PartCounts{16, 1}));
    EXPECT_EQ(pt::part_counts(1U << 31), (PartCounts{1U << 30, 1U << 30}));
    EXPECT_EQ(pt::part_counts(UINT32_MAX), (PartCounts{1U << 31, (1U << 31) - 1}));
}

// Adds sample after sample, folding where the counts say that part 0 has more than before, as the kernel does.
TEST(SampleParts, AddingAndFoldingGivesTheCounts) {
    PartCounts held{};
    for (std::uint32_t sample = 0; sample < 5000; ++sample) {
        const std::uint32_t older = pt::part_counts(sample + 1)[0];
        if (pt::part_of(sample) == 1 && older > held[0])
            held = {held[0] + held[1], 0};
        ++held[pt::part_of(sample)];
        ASSERT_EQ(held, pt::part_counts(sample + 1)) << sample;
    }
}

// Between a sample and the end given for it, neither the part changes nor the need for a fold; at the end one does.
TEST(SampleParts, EndWhereTheNextSampleGoesElsewhere) {
    const auto older_end = [](std::uint32_t sample) {
        return sample < pt::min_older_samples ? pt::min_older_samples : pt::part_counts(sample + 1)[0];
    };
    for (std::uint32_t sample = 0; sample < 1000; ++sample) {
        const std::uint32_t end = pt::end_of_part(sample);
        ASSERT_GT(end, sample);
        for (std::uint32_t other = sample; other < end; ++other) {
            ASSERT_EQ(pt::part_of(other), pt::part_of(sample)) << sample << ", " << other;
            ASSERT_EQ(older_end(other), older_end(sample)) << sample << ", " << other;
        }
        ASSERT_TRUE(pt::part_of(end) != pt::part_of(sample) || older_end(end) != older_end(sample)) << sample;
    }
    EXPECT_EQ(pt::end_of_part(1U << 31), UINT32_MAX);
}

} // namespace
