#include "lib/points/point_sequence.h"
#include "tests/support/data_folder.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
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

struct ExactInverse {
    std::uint64_t index;
    std::uint64_t base;
    double value;
    std::uint64_t floor_of_2_to_32;
};

std::vector<ExactInverse> exact_inverses() {
    std::ifstream file(data_folder() + "/radical_inverse.csv");
    std::vector<ExactInverse> table;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream fields(line);
        ExactInverse entry{};
        if (fields >> entry.index >> entry.base >> entry.value >> entry.floor_of_2_to_32)
            table.push_back(entry);
    }
    return table;
}

std::uint32_t dimension_of_base(std::uint64_t base) {
    std::uint32_t smaller = 0;
    for (std::uint64_t candidate = 2; candidate < base; ++candidate) {
        bool prime = true;
        for (std::uint64_t divisor = 2; divisor * divisor <= candidate; ++divisor)
            prime = prime && candidate % divisor != 0;
        smaller += prime ? 1 : 0;
    }
    return smaller;
}

TEST(RadicalInverse, IsExact) {
    const std::vector<ExactInverse> table = exact_inverses();
    ASSERT_EQ(table.size(), 171U);
    for (const ExactInverse &entry : table) {
        const std::uint32_t dimension = dimension_of_base(entry.base);
        ASSERT_LT(dimension, pt::sequence_dimensions);
        EXPECT_EQ(pt::radical_inverse(static_cast<std::uint32_t>(entry.index), dimension), entry.floor_of_2_to_32)
            << "index " << entry.index << ", base " << entry.base;
    }
}

TEST(RadicalInverse, OfTheLastDimensionMatchesItsDigits) {
    ASSERT_EQ(dimension_of_base(311), pt::sequence_dimensions - 1);
    for (const std::uint32_t index : {0U, 1U, 310U, 311U, 96720U, 4294967295U}) {
        long double value = 0.0L;
        long double place = 1.0L;
        for (std::uint32_t rest = index; rest != 0; rest /= 311) {
            place /= 311.0L;
            value += place * static_cast<long double>(rest % 311);
        }
        // The mantissa of long double has 64 bits, so only values within 2^-30 of an integer may have a wrong floor.
        const long double scaled = value * 4294967296.0L;
        EXPECT_NEAR(static_cast<double>(scaled), pt::radical_inverse(index, pt::sequence_dimensions - 1) + 0.5, 0.501)
            << "index " << index;
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

std::uint32_t reversed(std::uint32_t word) {
    std::uint32_t result = 0;
    for (int bit = 0; bit < 32; ++bit)
        result |= (word >> bit & 1U) << (31 - bit);
    return result;
}

// Vegdahl's hash (2021) of the reversed word, in 64-bit arithmetic.
std::uint32_t scrambled_in_64_bits(std::uint32_t coordinate, std::uint32_t seed) {
    constexpr std::uint64_t modulus = std::uint64_t{1} << 32;
    std::uint64_t v = reversed(coordinate);
    v ^= v * 0x3d20adeaU % modulus;
    v = (v + seed) % modulus;
    v = v * (seed / 65536 | 1U) % modulus;
    v ^= v * 0x05526c56U % modulus;
    v ^= v * 0x53a22864U % modulus;
    return reversed(static_cast<std::uint32_t>(v));
}

constexpr std::size_t random_count = 1U << 16;

TEST(OwenScrambling, IsExact) {
    std::mt19937 words(1);
    for (std::size_t i = 0; i < random_count; ++i) {
        const auto coordinate = static_cast<std::uint32_t>(words());
        const auto seed = static_cast<std::uint32_t>(words());
        ASSERT_EQ(pt::owen_scrambled(coordinate, seed), scrambled_in_64_bits(coordinate, seed));
    }
    for (std::uint32_t a = 0; a < 32; ++a)
        for (std::uint32_t b = 0; b < 32; ++b)
            for (const std::uint32_t flip : {0U, 0xffffffffU})
                EXPECT_EQ(pt::owen_scrambled(1U << a ^ flip, 1U << b), scrambled_in_64_bits(1U << a ^ flip, 1U << b));
    EXPECT_NE(pt::owen_scrambled(1, 2), scrambled_in_64_bits(1, 3));
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

TEST(PointTable, RowsAreThePoints) {
    const pt::PointLayout layout = all_dimensions();
    ASSERT_EQ(layout.dimensions_of(layout.block_count()), pt::sequence_dimensions);
    ASSERT_EQ(layout.dimensions_of(layout.shared_blocks), 1U + 2U + 3U);
    for (const std::uint32_t sampler : {PT_SAMPLER_SOBOL, PT_SAMPLER_HALTON, PT_SAMPLER_HALTON_CP}) {
        const Table table = pt::point_table(sampler, table_seed, some_indices, layout);
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

TEST(PointTable, TimeIsTheFifthDimensionOfSobol) {
    const pt::PointLayout layout{{3, 2, 2, 2}, 2, 1};
    const std::vector<Coordinates> dimensions =
        dimensions_of(pt::point_table(PT_SAMPLER_SOBOL, table_seed, some_indices, layout), layout);
    const std::uint32_t order[] = {0, 1, 4, 2, 3, 5, 6, 7, 8};
    for (std::size_t i = 0; i < std::size(order); ++i)
        for (std::uint32_t d = 0; d < std::size(order); ++d)
            EXPECT_EQ(is_scrambled_sobol(dimensions[i], some_indices, d), d == order[i]) << i << ", " << d;
}

TEST(PointTable, BlocksAreZeroBeyondTheirDimensions) {
    const pt::PointLayout layout = all_dimensions();
    const Table table = pt::point_table(PT_SAMPLER_SOBOL, table_seed, some_indices, layout);
    for (std::uint32_t block = 0; block < layout.block_count(); ++block)
        for (std::uint32_t component = layout.block_dimensions[block]; component < 4; ++component)
            EXPECT_EQ(column(table, layout, block, component), Coordinates(some_indices.size(), 0U));
}

TEST(PointTable, BranchesArePointsOfTheirOwnInTheDimensionsThatTheyDoNotShare) {
    const pt::PointLayout layout{{1, 2, 4, 2}, 2, 4};
    const Indices indices = {0, 5, 6, 0x40000001U};
    const Table table = pt::point_table(PT_SAMPLER_HALTON, table_seed, indices, layout);
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
