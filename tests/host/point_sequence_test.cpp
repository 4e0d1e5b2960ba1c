// Points of quasi-random sequences: radical inverses against exact values, Sobol points against the net properties that
// define them, and their scrambling against 64-bit arithmetic and the nesting that defines it.
#include "lib/kernel/point_sequence.h"

#include "tests/host/nets.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <random>
#include <set>
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

// Whether a function keeps how many first digits two coordinates have in common: then the first k digits of a result
// depend on the first k of the coordinate alone, and no two coordinates become one.
template <typename Function>
bool is_nested(const Function &function) {
    std::mt19937 words(2); // NOLINT: the same numbers each time
    for (std::size_t i = 0; i < random_count; ++i) {
        const auto a = static_cast<std::uint32_t>(words());
        const auto b = a ^ static_cast<std::uint32_t>(words()) >> i % 32; // i mod 32 digits alike, or more
        if (common_digits(function(a), function(b)) != common_digits(a, b))
            return false;
    }
    return true;
}

TEST(OwenScrambling, IsNested) {
    for (const std::uint32_t seed : {0U, 1U, 0x12345678U, 0x9e3779b9U, 0xffffffffU})
        EXPECT_TRUE(is_nested([=](std::uint32_t x) { return pt::owen_scrambled(x, seed); })) << "seed " << seed;
    EXPECT_TRUE(is_nested([](std::uint32_t x) { return x ^ 0x12345678U; }));
    EXPECT_FALSE(is_nested([](std::uint32_t x) { return x + 1; })) << "carries go from the last digits to the first";
    EXPECT_FALSE(is_nested([](std::uint32_t x) { return x & ~1U; })) << "the last digit is lost";
}

// Of the scramblings by many seeds: whether they flip each digit as often as not, and alike in no two digits of two
// coordinates. The deviations of 32 digits, and of their 31 * 16 pairs, with a false alarm in a million for all.
template <typename Function>
bool is_fair(const Function &scrambled) {
    constexpr std::uint32_t seeds = 1U << 14;
    const double bound = statistics::normal_quantile(1e-6 / (2 * (32 + 31 * 16)));
    const double allowed = bound * 0.5 * std::sqrt(seeds);
    std::array<std::uint32_t, 32> flips{};
    std::array<std::array<std::uint32_t, 32>, 32> alike{};
    std::mt19937 words(3); // NOLINT: the same numbers each time
    for (std::uint32_t i = 0; i < seeds; ++i) {
        const std::uint32_t result = scrambled(0xb7e15162U, static_cast<std::uint32_t>(words()));
        for (std::size_t a = 0; a < 32; ++a) {
            flips[a] += result >> a & 1U;
            for (std::size_t b = 0; b < a; ++b)
                alike[a][b] += (result >> a ^ result >> b) & 1U;
        }
    }
    const auto off = [&](std::uint32_t count) { return std::abs(count - 0.5 * seeds) > allowed; };
    bool fair = std::ranges::none_of(flips, off);
    for (std::size_t a = 0; a < 32; ++a)
        fair = fair && std::none_of(alike[a].begin(), alike[a].begin() + static_cast<std::ptrdiff_t>(a), off);
    return fair;
}

TEST(OwenScrambling, FlipsEachDigitForHalfOfTheSeeds) {
    EXPECT_TRUE(is_fair(&pt::owen_scrambled));
    EXPECT_FALSE(is_fair([](std::uint32_t x, std::uint32_t seed) { return x ^ (seed & ~4U); }));
    EXPECT_FALSE(is_fair([](std::uint32_t x, std::uint32_t seed) { return x ^ (seed << 1 ^ seed >> 31 << 3); }));
}

// What distinguishes Owen's scrambling from a shift: the same digit is flipped for some of the digits before it, and
// not for others.
TEST(OwenScrambling, DependsOnTheDigitsBefore) {
    std::set<std::uint32_t> shifts;
    for (std::uint32_t i = 0; i < 256; ++i) {
        const std::uint32_t coordinate = i << 24;
        shifts.insert((pt::owen_scrambled(coordinate, 0x12345678U) ^ coordinate) >> 16);
    }
    EXPECT_GT(shifts.size(), 128U);
}

TEST(OwenScrambling, DiffersBetweenSeeds) {
    std::set<Coordinates> distinct;
    for (std::uint32_t seed = 0; seed < 4096; ++seed) {
        Coordinates scrambled;
        for (std::uint32_t i = 0; i < 4; ++i)
            scrambled.push_back(pt::owen_scrambled(i << 30, seed * 0x9e3779b9U));
        distinct.insert(scrambled);
    }
    EXPECT_EQ(distinct.size(), 4096U);
}

} // namespace
