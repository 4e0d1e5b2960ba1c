#include "lib/points/point_sequence.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace {

using Coordinates = std::vector<std::uint32_t>;

bool fills_intervals(const Coordinates &points, std::uint32_t digits) {
    std::vector<std::uint32_t> hits(std::size_t{1} << digits);
    for (const std::uint32_t point : points)
        ++hits[std::uint64_t{point} >> (32 - digits)];
    return std::ranges::all_of(hits, [&](std::uint32_t count) { return count == points.size() >> digits; });
}

// Whether each box of 2^-digits_x by 2^-digits_y holds one of the 2^(digits_x + digits_y) points.
bool fills_boxes(const Coordinates &x, const Coordinates &y, std::uint32_t digits_x, std::uint32_t digits_y) {
    std::vector<std::uint32_t> hits(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        ++hits[((std::uint64_t{x[i]} >> (32 - digits_x)) << digits_y) + (std::uint64_t{y[i]} >> (32 - digits_y))];
    return std::ranges::all_of(hits, [](std::uint32_t count) { return count == 1; });
}

int common_digits(std::uint32_t a, std::uint32_t b) {
    return std::countl_zero(a ^ b);
}

// The inverse is 2^32 sum d_k b^-(k + 1), rounded down, for the index's digits d_k in base b. In long double the sum's
// error is below 2^-20.
TEST(RadicalInverse, IsTheSumOfMirroredDigits) {
    const auto is_prime = [](std::uint64_t number) {
        std::uint64_t divisor = 2;
        while (number % divisor != 0)
            ++divisor;
        return divisor == number;
    };
    std::uint64_t base = 1;
    for (std::uint32_t dimension = 0; dimension < pt::sequence_dimensions; ++dimension) {
        do
            ++base;
        while (!is_prime(base));
        for (const std::uint64_t index : {std::uint64_t{0}, std::uint64_t{1}, base - 1, base, base * base - 1,
                                          std::uint64_t{4294967295}, std::uint64_t{34359738367}}) {
            long double value = 0.0L;
            long double place = 4294967296.0L;
            for (std::uint64_t rest = index; rest > 0; rest /= base) {
                place /= static_cast<long double>(base);
                value += place * static_cast<long double>(rest % base);
            }
            EXPECT_NEAR(static_cast<double>(value), pt::radical_inverse(index, dimension) + 0.5, 0.5 + 0x1p-20)
                << "index " << index << ", base " << base;
        }
    }
}

Coordinates sobol_coordinates(std::uint32_t first, std::uint32_t count, std::uint32_t dimension) {
    Coordinates coordinates(count);
    for (std::uint32_t i = 0; i < count; ++i)
        coordinates[i] = pt::sobol(first + i, dimension);
    return coordinates;
}

constexpr std::uint32_t net_digits = 10;
constexpr std::uint32_t net_size = 1U << net_digits;
constexpr std::uint32_t net_starts[] = {0, net_size, 77 * net_size, 0x80000000U, 0xffffffffU - net_size + 1};

// A (0,1)-sequence in base 2: each aligned block of 2^k points has one point in each of 2^k intervals.
TEST(Sobol, EveryDimensionIsAZeroOneSequence) {
    for (std::uint32_t dimension = 0; dimension < pt::sequence_dimensions; ++dimension)
        for (const std::uint32_t start : net_starts)
            for (std::uint32_t digits = 0; digits <= net_digits; ++digits)
                EXPECT_TRUE(fills_intervals(sobol_coordinates(start, 1U << digits, dimension), digits))
                    << "dimension " << dimension << ", 2^" << digits << " points from " << start;
}

// A (0,2)-sequence in base 2: each aligned block of 2^m points has one point in each elementary box of volume 2^-m.
TEST(Sobol, TheFirstTwoDimensionsAreAZeroTwoSequence) {
    for (const std::uint32_t start : net_starts) {
        const Coordinates x = sobol_coordinates(start, net_size, 0);
        const Coordinates y = sobol_coordinates(start, net_size, 1);
        for (std::uint32_t digits = 0; digits <= net_digits; ++digits)
            EXPECT_TRUE(fills_boxes(x, y, digits, net_digits - digits)) << digits << " digits of x, from " << start;
    }
}

// A wrong dimension could repeat another dimension, and still be a (0,1)-sequence.
TEST(Sobol, DimensionsDiffer) {
    std::vector<Coordinates> all;
    for (std::uint32_t dimension = 0; dimension < pt::sequence_dimensions; ++dimension)
        all.push_back(sobol_coordinates(0, net_size, dimension));
    std::ranges::sort(all);
    EXPECT_EQ(std::ranges::adjacent_find(all), all.end());
}

TEST(Sobol, NegativeControls) {
    const Coordinates unaligned = sobol_coordinates(1, net_size / 2, 5);
    EXPECT_TRUE(fills_intervals(sobol_coordinates(0, net_size / 2, 5), net_digits - 1));
    EXPECT_FALSE(fills_intervals(unaligned, net_digits - 1));
    Coordinates one_bit_off = sobol_coordinates(0, net_size, 5);
    one_bit_off[300] ^= 1U << (32 - net_digits);
    EXPECT_FALSE(fills_intervals(one_bit_off, net_digits));
    const Coordinates x = sobol_coordinates(0, net_size, 0);
    bool all_filled = true;
    for (std::uint32_t digits = 0; digits <= net_digits; ++digits)
        all_filled = all_filled && fills_boxes(x, sobol_coordinates(0, net_size, 9), digits, net_digits - digits);
    EXPECT_FALSE(all_filled) << "dimensions 0 and 9 are no (0,2)-sequence";
}

using Table = std::vector<pt::PointBlock>;
using Indices = std::vector<std::uint32_t>;

constexpr std::uint64_t table_seed = 7;

pt::PointLayout all_dimensions() {
    pt::PointLayout layout{{}, 0, 1};
    for (std::uint32_t left = pt::sequence_dimensions; left > 0; left -= layout.block_dimensions.back())
        layout.block_dimensions.push_back(std::min(left, 1 + layout.block_count() % 4));
    layout.shared_blocks = 3;
    return layout;
}

Coordinates column(const Table &table, const pt::PointLayout &layout, std::uint32_t block, std::uint32_t component) {
    Coordinates coordinates;
    for (std::size_t row = 0; row < table.size(); row += layout.row_blocks())
        coordinates.push_back(table[row + block][component]);
    return coordinates;
}

std::vector<Coordinates> dimensions_of(const Table &table, const pt::PointLayout &layout) {
    std::vector<Coordinates> dimensions;
    for (std::uint32_t block = 0; block < layout.block_count(); ++block)
        for (std::uint32_t component = 0; component < layout.block_dimensions[block]; ++component)
            dimensions.push_back(column(table, layout, block, component));
    return dimensions;
}

bool is_scrambled_sobol(const Coordinates &coordinates, const Indices &indices, std::uint32_t dimension) {
    for (std::size_t i = 0; i < indices.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (common_digits(coordinates[i], coordinates[j]) !=
                common_digits(pt::sobol(indices[i], dimension), pt::sobol(indices[j], dimension)))
                return false;
    return true;
}

const Indices some_indices = {0, 1, 2, 7, 12345, 0x40000001U, 0x80000000U, 0xfffffffeU, 0xffffffffU};

// Sobol's point 0 is the origin, so its coordinates show the scrambles.
TEST(PointTable, RowsAreThePoints) {
    const pt::PointLayout layout = all_dimensions();
    ASSERT_EQ(layout.dimensions_of(layout.block_count()), pt::sequence_dimensions);
    ASSERT_EQ(layout.dimensions_of(layout.shared_blocks), 1U + 2U + 3U);
    for (const std::uint32_t sampler : {PT_SAMPLER_SOBOL, PT_SAMPLER_HALTON, PT_SAMPLER_HALTON_CP}) {
        const Table table = pt::point_table(sampler, table_seed, some_indices, layout);
        ASSERT_EQ(table.size(), some_indices.size() * layout.block_count());
        const std::vector<Coordinates> dimensions = dimensions_of(table, layout);
        std::set<std::uint32_t> of_first_point;
        for (std::uint32_t d = 0; d < pt::sequence_dimensions; ++d) {
            of_first_point.insert(dimensions[d][0]);
            Coordinates inverses;
            for (const std::uint32_t index : some_indices)
                inverses.push_back(pt::radical_inverse(index, d));
            EXPECT_EQ(dimensions[d] == inverses, sampler != PT_SAMPLER_SOBOL) << "dimension " << d;
            EXPECT_TRUE(sampler != PT_SAMPLER_SOBOL || is_scrambled_sobol(dimensions[d], some_indices, d));
        }
        EXPECT_EQ(of_first_point.size(), sampler == PT_SAMPLER_SOBOL ? pt::sequence_dimensions : 1U);
    }
}

TEST(PointTable, TimeIsTheFifthDimensionOfSobol) {
    const pt::PointLayout layout{{3, 2, 2, 2}, 2, 1};
    const std::vector<Coordinates> dimensions =
        dimensions_of(pt::point_table(PT_SAMPLER_SOBOL, table_seed, some_indices, layout), layout);
    const std::uint32_t order[] = {0, 1, 4, 2, 3, 5, 6, 7, 8};
    for (std::size_t i = 0; i < std::size(order); ++i)
        for (std::uint32_t d = 0; d < std::size(order); ++d)
            EXPECT_EQ(is_scrambled_sobol(dimensions[i], some_indices, d), d == order[i]) << i << ", " << d;
}

// The points of sample 2^30 + i are 2^32 + 4 i + b. Their low 32 bits repeat, so another scramble must distinguish
// them.
TEST(PointTable, OfSobolRepeatsNoPoint) {
    const pt::PointLayout layout{{3, 2, 4, 4}, 2, 4};
    const auto row_of = [&](std::uint32_t index) {
        return pt::point_table(PT_SAMPLER_SOBOL, table_seed, Indices{index}, layout);
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
