// The table of points that the kernel reads: whose coordinates it holds and where, and the scrambling of Sobol's.
#include "lib/kernel/point_sequence.h"

#include "tests/host/nets.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace {

using Table = std::vector<pt::PointBlock>;
using Indices = std::vector<std::uint32_t>;

constexpr std::uint64_t seed = 7;

// Blocks of all sizes, in all dimensions that there are.
pt::PointLayout all_dimensions() {
    pt::PointLayout layout{{}, 0, 1};
    for (std::uint32_t left = pt::sequence_dimensions; left > 0; left -= layout.block_dimensions.back())
        layout.block_dimensions.push_back(std::min(left, 1 + layout.block_count() % 4));
    layout.shared_blocks = 3;
    return layout;
}

// One coordinate of a block, of every row.
Coordinates column(const Table &table, const pt::PointLayout &layout, std::uint32_t block, std::uint32_t component) {
    Coordinates coordinates;
    for (std::size_t row = 0; row < table.size(); row += layout.row_blocks())
        coordinates.push_back(table[row + block][component]);
    return coordinates;
}

// All dimensions of the rows of a layout with one branch, one after the other.
std::vector<Coordinates> dimensions_of(const Table &table, const pt::PointLayout &layout) {
    std::vector<Coordinates> dimensions;
    for (std::uint32_t block = 0; block < layout.block_count(); ++block)
        for (std::uint32_t component = 0; component < layout.block_dimensions[block]; ++component)
            dimensions.push_back(column(table, layout, block, component));
    return dimensions;
}

// Whether coordinates are those of points of Sobol in a dimension, each digit flipped or not by those before it: any
// two have as many first digits in common as the points have.
bool is_scrambled_sobol(const Coordinates &coordinates, const Indices &indices, std::uint32_t dimension) {
    for (std::size_t i = 0; i < indices.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (common_digits(coordinates[i], coordinates[j]) !=
                common_digits(pt::sobol(indices[i], dimension), pt::sobol(indices[j], dimension)))
                return false;
    return true;
}

const Indices some_indices = {0, 1, 2, 7, 12345, 0x40000001U, 0x80000000U, 0xfffffffeU, 0xffffffffU};

TEST(PointTable, RowsAreThePoints) {
    const pt::PointLayout layout = all_dimensions();
    ASSERT_EQ(layout.dimensions(), pt::sequence_dimensions);
    ASSERT_EQ(layout.shared_dimensions(), 1U + 2U + 3U);
    for (const std::uint32_t sampler : {PT_SAMPLER_SOBOL, PT_SAMPLER_HALTON, PT_SAMPLER_HALTON_CP}) {
        const Table table = pt::point_table(sampler, seed, some_indices, layout);
        ASSERT_EQ(table.size(), some_indices.size() * layout.block_count());
        const std::vector<Coordinates> dimensions = dimensions_of(table, layout);
        for (std::uint32_t d = 0; d < pt::sequence_dimensions; ++d) {
            Coordinates inverses;
            for (const std::uint32_t index : some_indices)
                inverses.push_back(pt::radical_inverse(index, d));
            EXPECT_EQ(dimensions[d] == inverses, sampler != PT_SAMPLER_SOBOL) << "dimension " << d;
            EXPECT_TRUE(sampler != PT_SAMPLER_SOBOL || is_scrambled_sobol(dimensions[d], some_indices, d));
        }
    }
}

TEST(PointTable, BlocksAreZeroBeyondTheirDimensions) {
    const pt::PointLayout layout = all_dimensions();
    const Table table = pt::point_table(PT_SAMPLER_SOBOL, seed, some_indices, layout);
    for (std::uint32_t block = 0; block < layout.block_count(); ++block)
        for (std::uint32_t component = layout.block_dimensions[block]; component < 4; ++component)
            EXPECT_EQ(column(table, layout, block, component), Coordinates(some_indices.size(), 0U));
}

TEST(PointTable, BranchesArePointsOfTheirOwnInTheDimensionsThatTheyDoNotShare) {
    const pt::PointLayout layout{{1, 2, 4, 2}, 2, 4};
    const Indices indices = {0, 5, 6, 0x40000001U};
    const Table table = pt::point_table(PT_SAMPLER_HALTON, seed, indices, layout);
    ASSERT_EQ(layout.row_blocks(), 2U + 4U * 2U);
    ASSERT_EQ(table.size(), indices.size() * layout.row_blocks());
    auto block = table.begin();
    for (const std::uint32_t index : indices) {
        EXPECT_EQ(*block++, (pt::PointBlock{pt::radical_inverse(index, 0)}));
        EXPECT_EQ(*block++, (pt::PointBlock{pt::radical_inverse(index, 1), pt::radical_inverse(index, 2)}));
        for (std::uint32_t branch = 0; branch < 4; ++branch) {
            const std::uint64_t sample = std::uint64_t{4} * index + branch;
            EXPECT_EQ(*block++, (pt::PointBlock{pt::radical_inverse(sample, 3), pt::radical_inverse(sample, 4),
                                                pt::radical_inverse(sample, 5), pt::radical_inverse(sample, 6)}));
            EXPECT_EQ(*block++, (pt::PointBlock{pt::radical_inverse(sample, 7), pt::radical_inverse(sample, 8)}));
        }
    }
}

// With four branches sample 2^30 + i has the points 2^32 + 4 i + b, which Sobol's 32 bits repeat: scrambled in
// another way, no coordinate of a branch is that of sample i.
TEST(PointTable, OfSobolRepeatsNoPoint) {
    const pt::PointLayout layout{{3, 2, 4, 4}, 2, 4};
    const auto row_of = [&](std::uint32_t index) {
        return pt::point_table(PT_SAMPLER_SOBOL, seed, Indices{index}, layout);
    };
    const Table first = row_of(1);
    const Table repetition = row_of(0x40000001U);
    const Table last = row_of(0xc0000001U);
    for (std::size_t block = layout.shared_blocks; block < layout.row_blocks(); ++block)
        for (std::size_t component = 0; component < 4; ++component) {
            EXPECT_NE(first[block][component], repetition[block][component]);
            EXPECT_NE(first[block][component], last[block][component]);
            EXPECT_NE(repetition[block][component], last[block][component]);
        }
    for (std::uint32_t component = 0; component < 4; ++component)
        for (const std::uint32_t dimension : {5 + component, 9 + component}) {
            const std::size_t block = layout.shared_blocks + (dimension < 9 ? 0 : 1);
            Coordinates branches;
            for (std::size_t branch = 0; branch < 4; ++branch)
                branches.push_back(repetition[block + 2 * branch][component]);
            EXPECT_TRUE(is_scrambled_sobol(branches, {4, 5, 6, 7}, dimension));
        }
}

} // namespace
