// Tests of cli/film/sample_ranges.
#include "cli/film/film.h"

#include <gtest/gtest.h>

namespace {

using Ranges = std::vector<pt_sample_range>;

std::string missing(const pt_sample_range &wanted, const Ranges &there) {
    return cli::ranges_text(cli::missing_of(wanted, there));
}

TEST(SampleRanges, WhatIsMissing) {
    EXPECT_EQ(missing({0, 64}, {}), "[0, 64)");
    EXPECT_EQ(missing({0, 64}, {{0, 64}}), "none");
    EXPECT_EQ(missing({10, 20}, {{0, 64}}), "none");
    EXPECT_EQ(missing({0, 64}, {{8, 16}, {20, 64}}), "[0, 8), [16, 20)");
    EXPECT_EQ(missing({0, 64}, {{8, 16}}), "[0, 8), [16, 64)");
    EXPECT_EQ(missing({10, 20}, {{0, 5}, {30, 40}}), "[10, 20)");
    EXPECT_EQ(missing({10, 20}, {{0, 12}, {15, 40}}), "[12, 15)");
}

TEST(SampleRanges, HowMany) {
    EXPECT_EQ(cli::sample_count_of({{8, 16}, {20, 64}}), 52U);
    EXPECT_EQ(cli::sample_count_of({}), 0U);
}

} // namespace
