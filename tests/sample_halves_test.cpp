// The halves of the film: which samples they have, that ranges of samples are cut right, and that the halves of a Sobol point
// set are nets.
#include "point_sequence.h"
#include "sample_halves.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace {

class SampleHalves : public testing::TestWithParam<std::uint32_t> {};

TEST_P(SampleHalves, ShareEveryPair) {
    const pt::SampleHalves halves(GetParam());
    for (std::uint32_t pair = 0; pair < 100000; ++pair)
        ASSERT_NE(halves.half_of(2 * pair), halves.half_of(2 * pair + 1));
    EXPECT_NE(halves.half_of(0xfffffffeU), halves.half_of(0xffffffffU));
}

// The indices of the range that are in the half, in order.
std::vector<std::uint32_t> counted(const pt::SampleHalves &halves, std::uint32_t half, std::uint32_t first,
                                   std::uint32_t count) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < count; ++i)
        if (halves.half_of(first + i) == half)
            indices.push_back(first + i);
    return indices;
}

TEST_P(SampleHalves, OfARangeAreItsSamples) {
    const pt::SampleHalves halves(GetParam());
    for (const std::uint32_t offset : {0U, 1000U, 0x7ffffff0U, 0xffffffffU - 127})
        for (std::uint32_t first = offset; first < offset + 64; ++first)
            for (std::uint32_t count = 0; count <= 64; ++count)
                for (std::uint32_t half = 0; half < 2; ++half) {
                    const pt::HalfRange range = halves.range(half, first, count);
                    ASSERT_EQ(halves.indices(half, range), counted(halves, half, first, count))
                        << "half " << half << " of " << count << " samples from " << first;
                }
}

TEST_P(SampleHalves, OfTheLongestRangeHoldNoMoreThanAllowed) {
    const pt::SampleHalves halves(GetParam());
    for (const std::uint32_t most : {1U, 2U, 3U, 7U, 32U}) {
        const std::uint32_t longest = pt::longest_range(most);
        std::uint32_t largest = 0;
        std::uint32_t beyond = 0;
        for (std::uint32_t first = 0; first < 2048; ++first)
            for (std::uint32_t half = 0; half < 2; ++half) {
                for (std::uint32_t count = 0; count <= longest; ++count)
                    largest = std::max(largest, halves.range(half, first, count).sample_count);
                beyond = std::max(beyond, halves.range(half, first, longest + 1).sample_count);
            }
        EXPECT_EQ(largest, most);
        EXPECT_EQ(beyond, most + 1) << "a longer range would do";
    }
}

INSTANTIATE_TEST_SUITE_P(All, SampleHalves,
                         testing::Values(PT_SAMPLER_RANDOM, PT_SAMPLER_HALTON, PT_SAMPLER_HALTON_CP, PT_SAMPLER_SOBOL));

// How many digits a half of the first 2^digits points is short of having one point in each of 2^(digits - 1) intervals.
std::uint32_t missing_digits(const std::vector<std::uint32_t> &half, std::uint32_t digits, std::uint32_t dimension) {
    for (std::uint32_t kept = digits - 1;; --kept) {
        std::vector<std::size_t> hits(std::size_t{1} << kept);
        for (const std::uint32_t index : half)
            ++hits[std::uint64_t{pt::sobol(index, dimension)} >> (32 - kept)];
        if (std::ranges::all_of(hits, [&](std::size_t count) { return count == half.size() >> kept; }))
            return digits - 1 - kept;
    }
}

struct Stratification {
    std::uint32_t worst_of_first = 0; // of the dimensions of the place in the pixel and of the first vertex
    double mean = 0.0;                // of all dimensions
};

// Over point sets of 16 to 4096 points.
Stratification stratification(std::uint32_t mask) {
    constexpr std::uint32_t fewest_digits = 4;
    constexpr std::uint32_t most_digits = 12;
    constexpr std::uint32_t first_dimensions = 9;
    Stratification result;
    for (std::uint32_t digits = fewest_digits; digits <= most_digits; ++digits) {
        std::vector<std::uint32_t> half;
        for (std::uint32_t i = 0; i < 1U << digits; ++i)
            if (std::popcount(i & mask) % 2 == 0)
                half.push_back(i);
        for (std::uint32_t dimension = 0; dimension < pt::sequence_dimensions; ++dimension) {
            const std::uint32_t missing = missing_digits(half, digits, dimension);
            result.mean += missing;
            if (dimension < first_dimensions)
                result.worst_of_first = std::max(result.worst_of_first, missing);
        }
    }
    result.mean /= (most_digits - fewest_digits + 1) * pt::sequence_dimensions;
    return result;
}

// Halves of a Sobol point set estimate its error well if they are as well stratified as any set of their size. No mask does so
// in all dimensions at once: a random one is short of it by 0 digits in half of the dimensions, by 1 in a quarter, by 2 in an
// eighth, ..., on average by nearly 1. What must not be is a half without stratification in a dimension that matters.
TEST(SobolHalves, AreStratified) {
    const Stratification found = stratification(pt::gpu::half_mask(PT_SAMPLER_SOBOL));
    EXPECT_LE(found.worst_of_first, 4U);
    EXPECT_LT(found.mean, 1.1);
}

// A digit of a dimension that paths consume divides the points into the halves of that dimension: even and odd samples are the
// first digit of the first one, the parity of all bits that of the second.
TEST(SobolHalves, ByADigitInUseWouldNotBeStratified) {
    EXPECT_EQ(stratification(1).worst_of_first, 11U);
    EXPECT_EQ(stratification(0xffffffffU).worst_of_first, 11U);
}

} // namespace
