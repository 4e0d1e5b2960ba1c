#include "tests/light/sample_numbers.h"
#include "tests/support/numbers_of.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace sample_numbers;

namespace {

class Sampler : public testing::TestWithParam<std::uint32_t> {};

TEST_P(Sampler, StaysBelowOneAtTheLargestIndices) {
    Request request;
    request.pixel_count = 64;
    request.sample_count = 64;
    for (const std::uint32_t first : {0U, (1U << 24) - 32, 0xffffffffU - 63})
        for (const std::uint32_t pixel : {0U, 0xffffffffU - 63}) {
            request.first_sample = first;
            request.first_pixel = pixel;
            for (const std::uint32_t block : {0U, table_blocks - 1, table_blocks, 5000U}) {
                request.block = block;
                take(GetParam(), request);
            }
        }
}

TEST_P(Sampler, StaysBelowOneForWordsOfAllOnes) {
    Request request;
    request.pixel_count = 4096;
    const pt::PointBlock all_ones = {0xffffffffU, 0xffffffffU, 0xffffffffU, 0xffffffffU};
    const Blocks blocks = take_from(Table(table_blocks, all_ones), GetParam(), request);
    if (GetParam() == PT_SAMPLER_HALTON) {
        EXPECT_EQ(blocks, Blocks(blocks.size(), glm::uvec4((1U << 24) - 1)));
    }
}

TEST_P(Sampler, IsUniformOverPixels) {
    if (GetParam() == PT_SAMPLER_HALTON)
        GTEST_SKIP() << "the same in every pixel";
    Request request;
    request.pixel_count = 1U << 18;
    request.first_sample = 5;
    const Blocks blocks = take(GetParam(), request);
    EXPECT_LT(uniform_deviate(component(blocks, 0)), bound);
    EXPECT_LT(uniform_deviate(component(blocks, 3)), bound);
    EXPECT_LT(pair_deviate(component(blocks, 0), component(blocks, 1)), bound);
    EXPECT_LT(pair_deviate(component(blocks, 1), component(blocks, 3)), bound);
    EXPECT_LT(pair_deviate(component(blocks, 2, 0, 2), component(blocks, 2, 1, 2)), bound);
    request.block = 1;
    EXPECT_LT(pair_deviate(component(blocks, 3), component(take(GetParam(), request), 0)), bound);
}

TEST_P(Sampler, IsRandomBeyondTheTable) {
    Request request;
    request.block = table_blocks;
    request.pixel_count = 2;
    request.first_pixel = 77;
    request.sample_count = 1U << 17;
    const Blocks blocks = take(GetParam(), request);
    EXPECT_EQ(blocks, take(PT_SAMPLER_RANDOM, request));
    EXPECT_LT(uniform_deviate(component(blocks, 1)), bound);
    EXPECT_LT(pair_deviate(component(blocks, 0, 0, 2), component(blocks, 0, 1, 2)), bound);
    const Blocks one(blocks.begin(), blocks.begin() + request.sample_count);
    const Blocks other(blocks.begin() + request.sample_count, blocks.end());
    EXPECT_LT(pair_deviate(component(one, 2), component(other, 2)), bound);
    --request.block;
    request.sample_count = 256;
    EXPECT_EQ(take(GetParam(), request) == take(PT_SAMPLER_RANDOM, request), GetParam() == PT_SAMPLER_RANDOM);
}

// The random numbers have no table, so the sample index B i + b of branch b of B may exceed 2^32.
TEST(SamplerRandom, BranchesAreSamplesOfTheirOwn) {
    constexpr std::uint32_t branches = 4;
    Request request;
    request.pixel_count = 64;
    request.block = table_blocks;
    const auto branch_of = [&](std::uint32_t sample, std::uint32_t branch) {
        request.first_sample = sample;
        request.branch = branch;
        return take_from({}, PT_SAMPLER_RANDOM, request, branches);
    };
    const auto sample = [&](std::uint32_t index) {
        request.first_sample = index;
        request.branch = 0;
        return take(PT_SAMPLER_RANDOM, request);
    };
    EXPECT_EQ(branch_of(5, 3), sample(23));
    EXPECT_NE(branch_of(5, 3), sample(24));
    EXPECT_EQ(branch_of(0x3fffffffU, 3), sample(0xffffffffU));
    EXPECT_NE(branch_of(0x40000000U, 3), sample(3));
}

INSTANTIATE_TEST_SUITE_P(All, Sampler, testing::ValuesIn(numbers_of(&pt_render::sampler)),
                         [](const auto &param) { return "Number" + std::to_string(param.param); });

TEST(SamplerHalton, IsTheRadicalInverseInEveryPixel) {
    Request request;
    request.pixel_count = 16;
    request.first_sample = 0xffffffffU - 255;
    request.sample_count = 256;
    for (request.block = 0; request.block < table_blocks; ++request.block) {
        const Blocks blocks = take(PT_SAMPLER_HALTON, request);
        for (std::uint32_t i = 0; i < request.invocations(); ++i)
            for (std::uint32_t d = 0; d < 4; ++d)
                ASSERT_EQ(blocks[i][static_cast<int>(d)],
                          pt::radical_inverse(request.first_sample + i % 256, 4 * request.block + d) >> 8);
    }
}

// Branch b of B has in sample i the numbers of sample B * i + b, in blocks behind the shared ones.
TEST(SamplerHalton, OfABranchIsTheRadicalInverseOfASampleOfItsOwn) {
    constexpr std::uint32_t branches = 4;
    Request request;
    request.pixel_count = 2;
    request.first_sample = 0x40000000U - 8;
    request.sample_count = 16;
    const Table table = table_of(PT_SAMPLER_HALTON, request, branches);
    for (request.block = shared_blocks; request.block < table_blocks; ++request.block)
        for (request.branch = 0; request.branch < branches; ++request.branch) {
            const Blocks blocks = take_from(table, PT_SAMPLER_HALTON, request, branches);
            for (std::uint32_t i = 0; i < request.invocations(); ++i)
                for (std::uint32_t d = 0; d < 4; ++d) {
                    const std::uint64_t sample = std::uint64_t{request.first_sample} + i % request.sample_count;
                    ASSERT_EQ(blocks[i][static_cast<int>(d)],
                              pt::radical_inverse(branches * sample + request.branch, 4 * request.block + d) >> 8);
                }
        }
}

// Each pixel shifts the numbers, digit by digit or modulo 1. Truncation to 24 bits may change them by one unit.
bool is_shifted_in_pixels(const Table &table, const Blocks &blocks, std::uint32_t sampler, const Request &request) {
    constexpr std::uint32_t mask = (1U << 24) - 1;
    const auto shift_of = [&](std::uint32_t place, int d) {
        const std::uint32_t row = place % request.sample_count;
        const std::uint32_t point = table[row * table_blocks + request.block][static_cast<std::size_t>(d)] >> 8;
        return sampler == PT_SAMPLER_SOBOL ? blocks[place][d] ^ point : (blocks[place][d] - point) & mask;
    };
    for (std::uint32_t place = 0; place < request.invocations(); ++place)
        for (int d = 0; d < 4; ++d) {
            const std::uint32_t here = shift_of(place, d);
            const std::uint32_t first = shift_of(place - place % request.sample_count, d);
            if (sampler == PT_SAMPLER_SOBOL ? here != first : ((here - first + 1) & mask) > 2)
                return false;
        }
    return true;
}

// One shift per pixel and dimension keeps the points evenly spread.
TEST(SamplerShifts, AreOneInEachPixelAndDimension) {
    Request request;
    request.pixel_count = 256;
    request.sample_count = 64;
    request.first_sample = 1000;
    for (const std::uint32_t sampler : {PT_SAMPLER_HALTON_CP, PT_SAMPLER_SOBOL})
        for (request.block = 0; request.block < table_blocks; ++request.block) {
            const Table table = table_of(sampler, request);
            Blocks blocks = take(sampler, request);
            EXPECT_TRUE(is_shifted_in_pixels(table, blocks, sampler, request)) << sampler << ' ' << request.block;
            blocks[3 * request.sample_count + 7].y ^= 4;
            EXPECT_FALSE(is_shifted_in_pixels(table, blocks, sampler, request)) << sampler << ' ' << request.block;
        }
}

TEST(SamplerChecks, NegativeControls) {
    Request request;
    request.pixel_count = 1U << 18;
    EXPECT_GT(uniform_deviate(component(take(PT_SAMPLER_HALTON, request), 0)), bound);
    const Blocks blocks = take(PT_SAMPLER_RANDOM, request);
    const std::vector<std::uint32_t> x = component(blocks, 0);
    std::vector<std::uint32_t> y = component(blocks, 1);
    std::vector<std::uint32_t> skewed = x;
    for (std::size_t i = 0; i < x.size(); ++i) {
        skewed[i] = static_cast<std::uint32_t>(std::pow(x[i] / scale, 1.03) * scale);
        y[i] = i % 100 < 3 ? x[i] : y[i];
    }
    EXPECT_GT(uniform_deviate(skewed), bound);
    EXPECT_GT(pair_deviate(x, y), bound);
}

} // namespace
