#include "tests/light/sample_numbers.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

using namespace sample_numbers;

namespace {

TEST(SamplerSobol, ScramblesDifferBetweenPixelsDimensionsAndSeeds) {
    Request request;
    request.pixel_count = 1024;
    request.sample_count = 4;
    std::set<std::vector<std::uint32_t>> distinct;
    std::size_t taken = 0;
    for (const std::uint32_t seed : {1U, 2U})
        for (const std::uint32_t block : {0U, 1U}) {
            request.seed = {seed, 9};
            request.block = block;
            const Blocks blocks = take(PT_SAMPLER_SOBOL, request);
            for (std::uint32_t pixel = 0; pixel < request.pixel_count; ++pixel)
                for (int d = 0; d < 4; ++d, ++taken) {
                    const auto first = blocks.begin() + pixel * 4;
                    distinct.insert(component(Blocks(first, first + 4), d));
                }
        }
    EXPECT_EQ(distinct.size(), taken);
}

// Point 0 is the origin, so its numbers consist of scramble and shift. Their first digits must be independent between
// the blocks of a path, or Russian roulette is wrong at low sample counts.
std::vector<std::vector<std::uint32_t>> scrambles_of_blocks(int component_index) {
    std::vector<std::vector<std::uint32_t>> blocks;
    for (std::uint32_t block = 0; block < table_blocks; ++block) {
        std::vector<std::uint32_t> numbers;
        for (std::uint32_t seed = 0; seed < 16; ++seed) {
            Request request;
            request.seed = {0x9e3779b9U * (seed + 1), 0x85ebca6bU * (seed + 3)};
            request.pixel_count = 1U << 14;
            request.block = block;
            const auto drawn = component(take(PT_SAMPLER_SOBOL, request), component_index);
            numbers.insert(numbers.end(), drawn.begin(), drawn.end());
        }
        blocks.push_back(std::move(numbers));
    }
    return blocks;
}

double triple_deviate(const std::vector<std::uint32_t> &x, const std::vector<std::uint32_t> &y,
                      const std::vector<std::uint32_t> &z) {
    constexpr std::uint32_t cells = 16 * 16 * 16;
    std::vector<double> observed(cells);
    for (std::size_t i = 0; i < x.size(); ++i)
        ++observed[(x[i] >> 20) * 256 + (y[i] >> 20) * 16 + (z[i] >> 20)];
    return statistics::chi_square_deviate(observed, std::vector<double>(cells, static_cast<double>(x.size()) / cells));
}

// The shift of a block is a word of the pixel times the block's factor f. If a f1 + b f2 + c f3 = 0 for small integers
// a, b and c, the shifts of three blocks lie on few planes.
TEST(SobolScrambling, IsIndependentAmongThreeBlocksOfAPath) {
    for (const int which : {0, 1, 2}) {
        const auto blocks = scrambles_of_blocks(which);
        for (std::size_t left_out = 0; left_out < blocks.size(); ++left_out) {
            const auto &x = blocks[(left_out + 1) % blocks.size()];
            const auto &y = blocks[(left_out + 2) % blocks.size()];
            const auto &z = blocks[(left_out + 3) % blocks.size()];
            EXPECT_LT(triple_deviate(x, y, z), bound) << "component " << which << ", without block " << left_out;
        }
    }
}

} // namespace
