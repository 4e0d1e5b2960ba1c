// The tables of quasi-random points: radical inverses against exact values, Sobol points against the net properties that
// define them.
#include "point_sequence.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct ExactInverse {
    std::uint64_t index;
    std::uint64_t base;
    double value;
    std::uint64_t floor_of_2_to_32; // times the value, exactly
};

// tests/data/radical_inverse.csv: exact rational arithmetic, indices up to 2^32 - 1.
std::vector<ExactInverse> exact_inverses() {
    std::ifstream file(PT_TEST_DATA_DIR "/radical_inverse.csv");
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

// The dimension whose base is a prime: how many primes are smaller.
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

// The largest base of all, which the file does not have.
TEST(RadicalInverse, OfTheLastDimensionMatchesItsDigits) {
    ASSERT_EQ(dimension_of_base(311), pt::sequence_dimensions - 1);
    for (const std::uint32_t index : {0U, 1U, 310U, 311U, 96720U, 4294967295U}) {
        long double value = 0.0L;
        long double place = 1.0L;
        for (std::uint32_t rest = index; rest != 0; rest /= 311) {
            place /= 311.0L;
            value += place * static_cast<long double>(rest % 311);
        }
        // 64 bits of mantissa leave errors near 2^-62, so the floor can be off only within 2^-30 of a whole number.
        const long double scaled = value * 4294967296.0L;
        EXPECT_NEAR(static_cast<double>(scaled), pt::radical_inverse(index, pt::sequence_dimensions - 1) + 0.5, 0.501)
            << "index " << index;
    }
}

using Coordinates = std::vector<std::uint32_t>; // multiples of 2^-32

Coordinates sobol_coordinates(std::uint32_t first, std::uint32_t count, std::uint32_t dimension) {
    Coordinates coordinates(count);
    for (std::uint32_t i = 0; i < count; ++i)
        coordinates[i] = pt::sobol(first + i, dimension);
    return coordinates;
}

// Whether each interval [i, i + 1) / 2^digits holds equally many of the points; there are at least as many points.
bool fills_intervals(const Coordinates &points, std::uint32_t digits) {
    std::vector<std::uint32_t> hits(std::size_t{1} << digits);
    for (const std::uint32_t point : points)
        ++hits[std::uint64_t{point} >> (32 - digits)];
    return std::ranges::all_of(hits, [&](std::uint32_t count) { return count == points.size() >> digits; });
}

// Whether each box of 2^-digits_x by 2^-digits_y holds exactly one of 2^(digits_x + digits_y) points.
bool fills_boxes(const Coordinates &x, const Coordinates &y, std::uint32_t digits_x, std::uint32_t digits_y) {
    std::vector<std::uint32_t> hits(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        ++hits[((std::uint64_t{x[i]} >> (32 - digits_x)) << digits_y) + (std::uint64_t{y[i]} >> (32 - digits_y))];
    return std::ranges::all_of(hits, [](std::uint32_t count) { return count == 1; });
}

constexpr std::uint32_t net_digits = 10;
constexpr std::uint32_t net_size = 1U << net_digits;
constexpr std::uint32_t net_starts[] = {0, net_size, 77 * net_size, 0x80000000U, 0xffffffffU - net_size + 1};

// A (0,1)-sequence in base 2: every aligned block of 2^k points hits each of 2^k intervals once.
TEST(Sobol, EveryDimensionIsAZeroOneSequence) {
    for (std::uint32_t dimension = 0; dimension < pt::sequence_dimensions; ++dimension)
        for (const std::uint32_t start : net_starts)
            for (std::uint32_t digits = 0; digits <= net_digits; ++digits)
                EXPECT_TRUE(fills_intervals(sobol_coordinates(start, 1U << digits, dimension), digits))
                    << "dimension " << dimension << ", 2^" << digits << " points from " << start;
}

// A (0,2)-sequence in base 2: every aligned block of 2^m points has one in every elementary box of volume 2^-m.
TEST(Sobol, TheFirstTwoDimensionsAreAZeroTwoSequence) {
    for (const std::uint32_t start : net_starts) {
        const Coordinates x = sobol_coordinates(start, net_size, 0);
        const Coordinates y = sobol_coordinates(start, net_size, 1);
        for (std::uint32_t digits = 0; digits <= net_digits; ++digits)
            EXPECT_TRUE(fills_boxes(x, y, digits, net_digits - digits)) << digits << " digits of x, from " << start;
    }
}

// No two dimensions are alike: a wrong row of direction numbers could repeat another and still be a (0,1)-sequence.
TEST(Sobol, DimensionsDiffer) {
    std::vector<Coordinates> all;
    for (std::uint32_t dimension = 0; dimension < pt::sequence_dimensions; ++dimension)
        all.push_back(sobol_coordinates(0, net_size, dimension));
    std::ranges::sort(all);
    EXPECT_EQ(std::ranges::adjacent_find(all), all.end());
}

// The checks above must be able to fail.
TEST(Sobol, NegativeControls) {
    const Coordinates unaligned = sobol_coordinates(1, net_size / 2, 5); // 512 points across a boundary
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

TEST(PointTable, RowsAreThePoints) {
    constexpr std::uint32_t dimensions = 17;
    const std::vector<std::uint32_t> indices = {0, 1, 2, 7, 12345, 0xfffffffeU, 0xffffffffU};
    const pt::PointLayout layout{dimensions, dimensions, 1};
    const auto sobol = pt::point_table(PT_SAMPLER_SOBOL, indices, layout);
    const auto halton = pt::point_table(PT_SAMPLER_HALTON, indices, layout);
    EXPECT_EQ(pt::point_table(PT_SAMPLER_HALTON_CP, indices, layout), halton);
    ASSERT_EQ(sobol.size(), indices.size() * dimensions);
    ASSERT_EQ(halton.size(), indices.size() * dimensions);
    for (std::size_t i = 0; i < indices.size(); ++i)
        for (std::uint32_t d = 0; d < dimensions; ++d) {
            EXPECT_EQ(sobol[i * dimensions + d], reversed(pt::sobol(indices[i], d)));
            EXPECT_EQ(halton[i * dimensions + d], pt::radical_inverse(indices[i], d));
        }
}

TEST(PointTable, BranchesArePointsOfTheirOwnInTheDimensionsThatTheyDoNotShare) {
    constexpr pt::PointLayout layout{7, 3, 4};
    const std::vector<std::uint32_t> indices = {0, 5, 6, 0x40000001U};
    const auto table = pt::point_table(PT_SAMPLER_HALTON, indices, layout);
    ASSERT_EQ(layout.row_words(), 3U + 4U * 4U);
    ASSERT_EQ(table.size(), indices.size() * layout.row_words());
    const std::uint32_t *word = table.data();
    for (const std::uint32_t index : indices) {
        for (std::uint32_t d = 0; d < 3; ++d)
            EXPECT_EQ(*word++, pt::radical_inverse(index, d));
        for (std::uint32_t branch = 0; branch < 4; ++branch)
            for (std::uint32_t d = 3; d < 7; ++d)
                EXPECT_EQ(*word++, pt::radical_inverse(std::uint64_t{4} * index + branch, d));
    }
}

} // namespace
