#include "lib/points/point_sequence.h"
#include "sample_numbers.spv.h"
#include "shaders/specialization.h"
#include "tests/kernel/probe.h"
#include "tests/support/numbers_of.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace sample_numbers {

namespace {

struct Request {
    glm::uvec2 seed{1, 2};
    std::uint32_t first_pixel = 0;
    std::uint32_t pixel_count = 1;
    std::uint32_t first_sample = 0;
    std::uint32_t sample_count = 1;
    std::uint32_t block = 0;
    std::uint32_t branch = 0;

    std::uint32_t invocations() const { return pixel_count * sample_count; }
};

// Numbers times 2^24, pixel by pixel.
using Blocks = std::vector<glm::uvec4>;
using Numbers = std::vector<std::uint32_t>;
using Table = std::vector<pt::PointBlock>;

constexpr double scale = 16777216.0;
constexpr std::uint32_t table_blocks = 4;
constexpr std::uint32_t shared_blocks = 1;

Blocks as_integers(const std::vector<glm::vec4> &numbers) {
    Blocks blocks;
    for (const glm::vec4 &block : numbers) {
        const glm::dvec4 scaled = scale * glm::dvec4(block);
        for (int i = 0; i < 4; ++i)
            EXPECT_TRUE(scaled[i] >= 0.0 && scaled[i] < scale && scaled[i] == std::floor(scaled[i])) << block[i];
        blocks.emplace_back(scaled);
    }
    return blocks;
}

Table table_of(std::uint32_t sampler, const Request &request, std::uint32_t branches = 1) {
    Numbers indices(request.sample_count);
    std::iota(indices.begin(), indices.end(), request.first_sample);
    return pt::point_table(sampler, std::uint64_t{request.seed.x} << 32 | request.seed.y, indices,
                           {Numbers(table_blocks, 4), shared_blocks, branches});
}

Blocks take_from(const Table &table, std::uint32_t sampler, const Request &request, std::uint32_t branches = 1) {
    std::array<std::uint32_t, pt::gpu::CONSTANT_COUNT> constants{};
    constants[pt::gpu::ID_SAMPLER] = sampler;
    constants[pt::gpu::ID_TABLE_BLOCKS] = sampler == PT_SAMPLER_RANDOM ? 0 : table_blocks;
    constants[pt::gpu::ID_BRANCH_COUNT] = branches;
    constants[pt::gpu::ID_MAX_PATH_LENGTH] = 6000;
    constants[pt::gpu::ID_POINT_BLOCKS] = probe_point_blocks;
    Probe probe(sample_numbers_spirv(), sizeof request, constants);
    probe.set_points(table);
    return as_integers(probe.run<glm::vec4>({}, request.invocations(), request, request.invocations()));
}

Blocks take(std::uint32_t sampler, const Request &request, std::uint32_t branches = 1) {
    const bool in_table = sampler != PT_SAMPLER_RANDOM && request.block < table_blocks;
    return take_from(in_table ? table_of(sampler, request, branches) : Table{}, sampler, request, branches);
}

// The bound allows one false alarm in a million over at most 72 chi-squares.
const double bound = statistics::normal_quantile(1e-6 / 72);

// Returns the chi-square of cells of leading `bits`. Uniform and independent numbers fill all cells alike.
double deviate(const std::vector<Numbers> &together, std::uint32_t bits) {
    std::vector<double> observed(std::size_t{1} << (bits * together.size()));
    for (std::size_t i = 0; i < together[0].size(); ++i) {
        std::size_t cell = 0;
        for (const Numbers &numbers : together)
            cell = cell << bits | numbers[i] >> (24 - bits);
        ++observed[cell];
    }
    const double expected = static_cast<double>(together[0].size()) / static_cast<double>(observed.size());
    return statistics::chi_square_deviate(observed, std::vector<double>(observed.size(), expected));
}

double uniform_deviate(const Numbers &numbers) {
    return deviate({numbers}, 8);
}

double pair_deviate(const Numbers &x, const Numbers &y) {
    return deviate({x, y}, 6);
}

Numbers component(const Blocks &blocks, int which, std::size_t first = 0, std::size_t stride = 1) {
    Numbers numbers;
    for (std::size_t i = first; i < blocks.size(); i += stride)
        numbers.push_back(blocks[i][which]);
    return numbers;
}

class Sampler : public testing::TestWithParam<std::uint32_t> {};

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
    const Numbers of_both = component(blocks, 2);
    const auto middle = of_both.begin() + request.sample_count;
    EXPECT_LT(pair_deviate({of_both.begin(), middle}, {middle, of_both.end()}), bound);
    --request.block;
    request.sample_count = 256;
    EXPECT_EQ(take(GetParam(), request) == take(PT_SAMPLER_RANDOM, request), GetParam() == PT_SAMPLER_RANDOM);
}

INSTANTIATE_TEST_SUITE_P(All, Sampler, testing::ValuesIn(numbers_of(&pt_render::sampler)),
                         [](const auto &param) { return "Number" + std::to_string(param.param); });

// The random numbers have no table, so the sample index B i + b of branch b of B may exceed 2^32.
TEST(SamplerRandom, BranchesAreSamplesOfTheirOwn) {
    Request request;
    request.pixel_count = 64;
    request.block = table_blocks;
    const auto numbers = [&](std::uint32_t sample, std::uint32_t branch, std::uint32_t branches) {
        request.first_sample = sample;
        request.branch = branch;
        return take(PT_SAMPLER_RANDOM, request, branches);
    };
    EXPECT_EQ(numbers(5, 3, 4), numbers(23, 0, 1));
    EXPECT_NE(numbers(5, 3, 4), numbers(24, 0, 1));
    EXPECT_EQ(numbers(0x3fffffffU, 3, 4), numbers(0xffffffffU, 0, 1));
    EXPECT_NE(numbers(0x40000000U, 3, 4), numbers(3, 0, 1));
}

// Behind the shared blocks, branch b of B takes the numbers of sample B i + b for its sample i.
TEST(SamplerHalton, IsTheRadicalInverseInEveryPixel) {
    for (const std::uint32_t branches : {1U, 4U})
        for (std::uint32_t block = branches > 1 ? shared_blocks : 0; block < table_blocks; ++block)
            for (std::uint32_t branch = 0; branch < branches; ++branch) {
                Request request;
                request.pixel_count = 2;
                request.sample_count = 16;
                request.first_sample = branches > 1 ? 0x40000000U - 8 : 0xffffffffU - 15;
                request.block = block;
                request.branch = branch;
                const Blocks blocks = take(PT_SAMPLER_HALTON, request, branches);
                for (std::uint32_t i = 0; i < request.invocations(); ++i) {
                    const std::uint64_t sample = std::uint64_t{request.first_sample} + i % request.sample_count;
                    for (std::uint32_t d = 0; d < 4; ++d)
                        ASSERT_EQ(blocks[i][static_cast<int>(d)],
                                  pt::radical_inverse(branches * sample + branch, 4 * block + d) >> 8);
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

// Point 0 is the origin, so its numbers consist of scramble and shift. The shift of a block is a word of the pixel
// times the block's factor f. If a f1 + b f2 + c f3 = 0 for small integers a, b and c, the shifts of three blocks lie
// on few planes. Then Russian roulette is wrong at low sample counts.
TEST(SamplerShifts, AreIndependentAmongThreeBlocksOfAPath) {
    for (const int which : {0, 1, 2}) {
        std::array<Numbers, table_blocks> blocks;
        Request request;
        request.pixel_count = 1U << 14;
        for (request.block = 0; request.block < table_blocks; ++request.block)
            for (std::uint32_t seed = 0; seed < 16; ++seed) {
                request.seed = {0x9e3779b9U * (seed + 1), 0x85ebca6bU * (seed + 3)};
                const Numbers drawn = component(take(PT_SAMPLER_SOBOL, request), which);
                blocks[request.block].insert(blocks[request.block].end(), drawn.begin(), drawn.end());
            }
        for (std::size_t i = 0; i < table_blocks; ++i)
            EXPECT_LT(deviate({blocks[i], blocks[(i + 1) % 4], blocks[(i + 2) % 4]}, 4), bound)
                << "component " << which << ", from block " << i;
    }
}

TEST(SamplerChecks, NegativeControls) {
    Request request;
    request.pixel_count = 1U << 18;
    EXPECT_GT(uniform_deviate(component(take(PT_SAMPLER_HALTON, request), 0)), bound);
    const Blocks blocks = take(PT_SAMPLER_RANDOM, request);
    const Numbers x = component(blocks, 0);
    Numbers y = component(blocks, 1);
    Numbers skewed = x;
    for (std::size_t i = 0; i < x.size(); ++i) {
        skewed[i] = static_cast<std::uint32_t>(std::pow(x[i] / scale, 1.03) * scale);
        y[i] = i % 100 < 3 ? x[i] : y[i];
    }
    EXPECT_GT(uniform_deviate(skewed), bound);
    EXPECT_GT(pair_deviate(x, y), bound);
}

} // namespace

} // namespace sample_numbers
