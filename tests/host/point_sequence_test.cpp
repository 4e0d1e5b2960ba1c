// Points of quasi-random sequences: radical inverses against exact values, Sobol points against the net properties that
// define them, and their scrambling against 64-bit arithmetic.
#include "lib/kernel/point_sequence.h"

#include "tests/host/nets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <random>
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

Coordinates sobol_coordinates(std::uint32_t first, std::uint32_t count, std::uint32_t dimension) {
    Coordinates coordinates(count);
    for (std::uint32_t i = 0; i < count; ++i)
        coordinates[i] = pt::sobol(first + i, dimension);
    return coordinates;
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

// The hash of Vegdahl (2021) on a word with its bits reversed, and the bits put in order again, in 64 bits.
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
    std::mt19937 words(1); // NOLINT: the same numbers each time
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

} // namespace
