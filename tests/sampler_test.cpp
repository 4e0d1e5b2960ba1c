// The numbers of samples as the device makes them: range, uniformity, and what each sampler promises about pixels.
// Run alone with --gtest_filter=Sampler*.
#include "gpu_layout.h"
#include "point_sequence.h"
#include "probe.h"
#include "sample_numbers.spv.h"
#include "statistics.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace {

// What the probe takes as push constants: which samples of which pixels, and which dimensions of them.
struct Request {
    glm::uvec2 seed{1, 2};
    std::uint32_t first_pixel = 0;
    std::uint32_t pixel_count = 1;
    std::uint32_t first_sample = 0;
    std::uint32_t sample_count = 1;
    std::uint32_t first_dimension = 0;
    std::uint32_t dimension_count = 4;

    std::uint32_t invocations() const { return pixel_count * sample_count; }
};

// Numbers as multiples of 2^-24, pixel by pixel.
using Blocks = std::vector<glm::uvec4>;

constexpr double scale = 16777216.0; // 2^24

Blocks as_integers(const std::vector<glm::vec4> &numbers) {
    Blocks blocks;
    for (const glm::vec4 &block : numbers) {
        glm::uvec4 integers;
        for (int i = 0; i < 4; ++i) {
            const double scaled = scale * static_cast<double>(block[i]);
            EXPECT_TRUE(scaled >= 0.0 && scaled < scale && scaled == std::floor(scaled)) << block[i];
            integers[i] = static_cast<std::uint32_t>(scaled);
        }
        blocks.push_back(integers);
    }
    return blocks;
}

constexpr std::uint32_t table_dimensions = 24;

Blocks take_from(const std::vector<std::uint32_t> &table, std::uint32_t sampler, const Request &request) {
    std::array<std::uint32_t, pt::gpu::CONSTANT_COUNT> constants{};
    constants[pt::gpu::ID_SAMPLER] = sampler;
    constants[pt::gpu::ID_TABLE_DIMENSIONS] = sampler == PT_SAMPLER_RANDOM ? 0 : table_dimensions;
    Probe probe(sample_numbers_spirv, sizeof request, constants);
    probe.set_points(table);
    return as_integers(probe.run<glm::vec4>({}, request.invocations(), request, request.invocations()));
}

Blocks take(std::uint32_t sampler, const Request &request) {
    if (sampler == PT_SAMPLER_RANDOM)
        return take_from({}, sampler, request);
    std::vector<std::uint32_t> indices(request.sample_count);
    std::iota(indices.begin(), indices.end(), request.first_sample);
    const pt::PointLayout layout{table_dimensions, table_dimensions, 1};
    return take_from(pt::point_table(sampler, indices, layout), sampler, request);
}

// One false alarm in a million, over the at most 40 chi-squares of this file together.
const double bound = statistics::normal_quantile(1e-6 / 40);

// Chi-square deviate of numbers against uniform ones.
double uniform_deviate(const std::vector<std::uint32_t> &numbers) {
    constexpr std::uint32_t cells = 256;
    std::vector<double> observed(cells);
    for (const std::uint32_t number : numbers)
        ++observed[number >> 16];
    return statistics::chi_square_deviate(observed,
                                          std::vector<double>(cells, static_cast<double>(numbers.size()) / cells));
}

// Chi-square deviate of pairs of numbers against uniform ones of the square.
double pair_deviate(const std::vector<std::uint32_t> &x, const std::vector<std::uint32_t> &y) {
    constexpr std::uint32_t side_bits = 6;
    constexpr std::uint32_t cells = 1U << (2 * side_bits);
    std::vector<double> observed(cells);
    for (std::size_t i = 0; i < x.size(); ++i)
        ++observed[(x[i] >> (24 - side_bits) << side_bits) + (y[i] >> (24 - side_bits))];
    return statistics::chi_square_deviate(observed, std::vector<double>(cells, static_cast<double>(x.size()) / cells));
}

// One component of blocks, every stride-th from first on.
std::vector<std::uint32_t> component(const Blocks &blocks, int which, std::size_t first = 0, std::size_t stride = 1) {
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = first; i < blocks.size(); i += stride)
        numbers.push_back(blocks[i][which]);
    return numbers;
}

class Sampler : public testing::TestWithParam<std::uint32_t> {};

// as_integers() checks each number.
TEST_P(Sampler, StaysBelowOneAtTheLargestIndices) {
    Request request;
    request.pixel_count = 64;
    request.sample_count = 64;
    for (const std::uint32_t first : {0U, (1U << 24) - 32, 0xffffffffU - 63})
        for (const std::uint32_t pixel : {0U, 0xffffffffU - 63}) {
            request.first_sample = first;
            request.first_pixel = pixel;
            for (const std::uint32_t dimension : {0U, 20U, 21U, 24U, 5000U}) { // 21 straddles the end of the table
                request.first_dimension = dimension;
                take(GetParam(), request);
            }
        }
}

TEST_P(Sampler, StaysBelowOneForWordsOfAllOnes) {
    Request request;
    request.pixel_count = 4096;
    const Blocks blocks = take_from(std::vector<std::uint32_t>(table_dimensions, 0xffffffffU), GetParam(), request);
    if (GetParam() == PT_SAMPLER_HALTON) {
        EXPECT_EQ(blocks, Blocks(blocks.size(), glm::uvec4((1U << 24) - 1)));
    }
}

// In each pixel alone a number is uniform over samples; over pixels each sample is, unless all pixels share it.
TEST_P(Sampler, IsUniformOverPixels) {
    if (GetParam() == PT_SAMPLER_HALTON)
        GTEST_SKIP() << "the same in every pixel";
    Request request;
    request.pixel_count = 1U << 18;
    request.first_sample = 5;
    const Blocks blocks = take(GetParam(), request);
    EXPECT_LT(uniform_deviate(component(blocks, 0)), bound);
    EXPECT_LT(uniform_deviate(component(blocks, 3)), bound);
    // Neighbouring dimensions, and neighbouring pixels.
    EXPECT_LT(pair_deviate(component(blocks, 0), component(blocks, 1)), bound);
    EXPECT_LT(pair_deviate(component(blocks, 1), component(blocks, 3)), bound);
    EXPECT_LT(pair_deviate(component(blocks, 2, 0, 2), component(blocks, 2, 1, 2)), bound);
    // Dimensions of neighbouring blocks.
    request.first_dimension = 4;
    EXPECT_LT(pair_deviate(component(blocks, 3), component(take(GetParam(), request), 0)), bound);
}

// A dimension that the table does not have is random whatever the sampler; so is every one of the random sampler.
TEST_P(Sampler, IsRandomBeyondTheTable) {
    Request request;
    request.first_dimension = table_dimensions - 3; // one of the four is beyond, so the block is
    request.pixel_count = 2;
    request.first_pixel = 77;
    request.sample_count = 1U << 17;
    const Blocks blocks = take(GetParam(), request);
    EXPECT_EQ(blocks, take(PT_SAMPLER_RANDOM, request));
    EXPECT_LT(uniform_deviate(component(blocks, 1)), bound);
    // Successive samples, and samples of neighbouring pixels.
    EXPECT_LT(pair_deviate(component(blocks, 0, 0, 2), component(blocks, 0, 1, 2)), bound);
    const Blocks one(blocks.begin(), blocks.begin() + request.sample_count);
    const Blocks other(blocks.begin() + request.sample_count, blocks.end());
    EXPECT_LT(pair_deviate(component(one, 2), component(other, 2)), bound);
    // The last block within the table is not.
    --request.first_dimension;
    EXPECT_EQ(take(GetParam(), request) == take(PT_SAMPLER_RANDOM, request), GetParam() == PT_SAMPLER_RANDOM);
}

std::string name_of(const testing::TestParamInfo<std::uint32_t> &info) {
    constexpr const char *names[] = {"", "Random", "Halton", "HaltonCp", "Sobol"};
    return names[info.param];
}

INSTANTIATE_TEST_SUITE_P(All, Sampler,
                         testing::Values(PT_SAMPLER_RANDOM, PT_SAMPLER_HALTON, PT_SAMPLER_HALTON_CP, PT_SAMPLER_SOBOL),
                         &name_of);

TEST(SamplerHalton, IsTheRadicalInverseInEveryPixel) {
    Request request;
    request.pixel_count = 16;
    request.first_sample = 0xffffffffU - 255;
    request.sample_count = 256;
    for (request.first_dimension = 0; request.first_dimension < table_dimensions; request.first_dimension += 4) {
        const Blocks blocks = take(PT_SAMPLER_HALTON, request);
        for (std::uint32_t i = 0; i < request.invocations(); ++i)
            for (std::uint32_t d = 0; d < 4; ++d)
                ASSERT_EQ(blocks[i][static_cast<int>(d)],
                          pt::radical_inverse(request.first_sample + i % 256, request.first_dimension + d) >> 8);
    }
}

// Whether the difference modulo 1 between a sample and the first one is the same in every pixel: the sum of 32-bit words is
// exact, but cutting each to 24 bits leaves a difference of 0 or 1 unit, and so 2 units between the extremes.
bool rotations_are_constant(const Blocks &blocks, std::uint32_t pixels, std::uint32_t samples) {
    constexpr std::uint32_t mask = (1U << 24) - 1;
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel)
        for (std::uint32_t sample = 0; sample < samples; ++sample)
            for (int d = 0; d < 4; ++d) {
                const std::uint32_t here = blocks[pixel * samples + sample][d] - blocks[pixel * samples][d];
                const std::uint32_t there = blocks[sample][d] - blocks[0][d];
                if (((here - there + 2) & mask) > 4)
                    return false;
            }
    return true;
}

TEST(SamplerHaltonCp, RotatesEachPixelAndDimensionByAConstant) {
    Request request;
    request.pixel_count = 256;
    request.sample_count = 64;
    request.first_sample = 1000;
    request.first_dimension = 4;
    Blocks blocks = take(PT_SAMPLER_HALTON_CP, request);
    EXPECT_TRUE(rotations_are_constant(blocks, request.pixel_count, request.sample_count));
    blocks[3 * request.sample_count + 7].y ^= 4;
    EXPECT_FALSE(rotations_are_constant(blocks, request.pixel_count, request.sample_count));
}

// The rotation itself is what point 0, all zeros, becomes; IsUniformOverPixels tests its distribution about another point.
TEST(SamplerHaltonCp, RotationsAreUniform) {
    Request request;
    request.pixel_count = 1U << 18;
    const Blocks blocks = take(PT_SAMPLER_HALTON_CP, request);
    EXPECT_LT(uniform_deviate(component(blocks, 0)), bound);
    EXPECT_LT(pair_deviate(component(blocks, 0, 0, 2), component(blocks, 0, 1, 2)), bound);
}

// Whether 2^digits numbers fall one into each interval of that length.
bool is_net(const std::vector<std::uint32_t> &numbers, std::uint32_t digits) {
    std::set<std::uint32_t> intervals;
    for (const std::uint32_t number : numbers)
        intervals.insert(number >> (24 - digits));
    return intervals.size() == std::size_t{1} << digits;
}

// Owen scrambling permutes the intervals of each length among themselves: what was a net stays one.
TEST(SamplerSobol, StaysANetInEveryPixelAndDimension) {
    for (const std::uint32_t digits : {4U, 6U, 8U})
        for (const std::uint32_t first_block : {0U, 5U})
            for (std::uint32_t dimension = 0; dimension < table_dimensions; dimension += 4) {
                Request request;
                request.pixel_count = 64;
                request.sample_count = 1U << digits;
                request.first_sample = first_block << digits;
                request.first_dimension = dimension;
                const Blocks blocks = take(PT_SAMPLER_SOBOL, request);
                for (std::uint32_t pixel = 0; pixel < request.pixel_count; ++pixel) {
                    const auto first = blocks.begin() + (pixel << digits);
                    const Blocks here(first, first + (1 << digits));
                    for (int d = 0; d < 4; ++d) {
                        std::vector<std::uint32_t> numbers = component(here, d);
                        ASSERT_TRUE(is_net(numbers, digits)) << "pixel " << pixel << " dimension " << dimension + d;
                        numbers[1] = numbers[0];
                        ASSERT_FALSE(is_net(numbers, digits)) << "two in one interval";
                    }
                }
            }
}

// In two dimensions too: the first two, scrambled independently, stay a (0,2)-net.
TEST(SamplerSobol, FirstTwoDimensionsStayANet) {
    Request request;
    request.pixel_count = 64;
    request.sample_count = 256;
    const Blocks blocks = take(PT_SAMPLER_SOBOL, request);
    for (std::uint32_t pixel = 0; pixel < request.pixel_count; ++pixel)
        for (std::uint32_t digits = 0; digits <= 8; ++digits) {
            std::set<std::uint32_t> boxes;
            for (std::uint32_t i = 0; i < 256; ++i) {
                const glm::uvec4 point = blocks[pixel * 256 + i];
                boxes.insert((point.x >> (24 - digits) << 8) + (point.y >> (16 + digits)));
            }
            ASSERT_EQ(boxes.size(), 256U) << "pixel " << pixel << ", " << digits << " digits of x";
        }
}

// 64 points of 24 bits: two equal sets by chance are out of the question.
TEST(SamplerSobol, ScramblesDifferBetweenPixelsDimensionsAndSeeds) {
    Request request;
    request.pixel_count = 1024;
    request.sample_count = 4;
    std::set<std::vector<std::uint32_t>> distinct;
    std::size_t taken = 0;
    for (const std::uint32_t seed : {1U, 2U})
        for (const std::uint32_t dimension : {0U, 4U}) {
            request.seed = {seed, 9};
            request.first_dimension = dimension;
            const Blocks blocks = take(PT_SAMPLER_SOBOL, request);
            for (std::uint32_t pixel = 0; pixel < request.pixel_count; ++pixel)
                for (int d = 0; d < 4; ++d, ++taken) {
                    const auto first = blocks.begin() + pixel * 4;
                    distinct.insert(component(Blocks(first, first + 4), d));
                }
        }
    EXPECT_EQ(distinct.size(), taken);
}

// The chi-squares must be able to fail: Halton's points of one pixel are far more even than random ones are, but repeated
// over pixels they are far less so, and a correlation of 3 in 100 between neighbours shows.
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

// The point with index 0 lies at the origin in every dimension, so its scrambled numbers are the scrambling alone. Their
// first digits must be independent between the blocks of a path, or paths whose fate hangs on several of them (Russian
// roulette) come out wrong at low sample counts. Seeds and pixels vary together.
std::vector<std::vector<std::uint32_t>> scrambles_of_blocks(int component_index) {
    std::vector<std::vector<std::uint32_t>> blocks;
    for (std::uint32_t first = 2; first + 4 <= table_dimensions; first += 5) {
        std::vector<std::uint32_t> numbers;
        for (std::uint32_t seed = 0; seed < 16; ++seed) {
            Request request;
            request.seed = {0x9e3779b9U * (seed + 1), 0x85ebca6bU * (seed + 3)};
            request.pixel_count = 1U << 14;
            request.first_dimension = first;
            const auto drawn = component(take(PT_SAMPLER_SOBOL, request), component_index);
            numbers.insert(numbers.end(), drawn.begin(), drawn.end());
        }
        blocks.push_back(std::move(numbers));
    }
    return blocks;
}

TEST(SobolScrambling, IsIndependentBetweenTheBlocksOfAPath) {
    for (const int which : {0, 1, 2}) {
        const auto blocks = scrambles_of_blocks(which);
        for (std::size_t a = 0; a < blocks.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                EXPECT_LT(pair_deviate(blocks[a], blocks[b]), bound)
                    << "component " << which << ", blocks " << a << ", " << b;
    }
}

} // namespace
