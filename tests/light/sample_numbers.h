#pragma once

#include "lib/points/point_sequence.h"
#include "sample_numbers.spv.h"
#include "shaders/specialization.h"
#include "tests/kernel/probe.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sample_numbers {

struct Request {
    glm::uvec2 seed{1, 2};
    std::uint32_t first_pixel = 0;
    std::uint32_t pixel_count = 1;
    std::uint32_t first_sample = 0;
    std::uint32_t sample_count = 1;
    std::uint32_t block = 0;
    std::uint32_t branch = 0;

    std::uint32_t invocations() const { return pixel_count * sample_count; }
    std::uint64_t table_seed() const { return std::uint64_t{seed.x} << 32 | seed.y; }
};

// Numbers times 2^24, pixel by pixel.
using Blocks = std::vector<glm::uvec4>;

inline constexpr double scale = 16777216.0;

inline Blocks as_integers(const std::vector<glm::vec4> &numbers) {
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

inline constexpr std::uint32_t table_blocks = 4;
inline constexpr std::uint32_t shared_blocks = 1;
inline constexpr std::uint32_t most_blocks = 6000;

inline pt::PointLayout layout_of(std::uint32_t branches) {
    return {std::vector<std::uint32_t>(table_blocks, 4), shared_blocks, branches};
}

using Table = std::vector<pt::PointBlock>;

inline Table table_of(std::uint32_t sampler, const Request &request, std::uint32_t branches = 1) {
    std::vector<std::uint32_t> indices(request.sample_count);
    std::iota(indices.begin(), indices.end(), request.first_sample);
    return pt::point_table(sampler, request.table_seed(), indices, layout_of(branches));
}

inline Blocks take_from(const Table &table, std::uint32_t sampler, const Request &request, std::uint32_t branches = 1) {
    std::array<std::uint32_t, pt::gpu::CONSTANT_COUNT> constants{};
    constants[pt::gpu::ID_SAMPLER] = sampler;
    constants[pt::gpu::ID_TABLE_BLOCKS] = sampler == PT_SAMPLER_RANDOM ? 0 : table_blocks;
    constants[pt::gpu::ID_BRANCH_COUNT] = branches;
    constants[pt::gpu::ID_MAX_PATH_LENGTH] = most_blocks;
    constants[pt::gpu::ID_POINT_BLOCKS] = probe_point_blocks;
    Probe probe(sample_numbers_spirv(), sizeof request, constants);
    probe.set_points(table);
    return as_integers(probe.run<glm::vec4>({}, request.invocations(), request, request.invocations()));
}

inline Blocks take(std::uint32_t sampler, const Request &request) {
    const bool in_table = sampler != PT_SAMPLER_RANDOM && request.block < table_blocks;
    return take_from(in_table ? table_of(sampler, request) : Table{}, sampler, request);
}

// The bound allows one false alarm in a million over at most 72 chi-squares.
inline const double bound = statistics::normal_quantile(1e-6 / 72);

inline double uniform_deviate(const std::vector<std::uint32_t> &numbers) {
    constexpr std::uint32_t cells = 256;
    std::vector<double> observed(cells);
    for (const std::uint32_t number : numbers)
        ++observed[number >> 16];
    return statistics::chi_square_deviate(observed,
                                          std::vector<double>(cells, static_cast<double>(numbers.size()) / cells));
}

inline double pair_deviate(const std::vector<std::uint32_t> &x, const std::vector<std::uint32_t> &y) {
    constexpr std::uint32_t side_bits = 6;
    constexpr std::uint32_t cells = 1U << (2 * side_bits);
    std::vector<double> observed(cells);
    for (std::size_t i = 0; i < x.size(); ++i)
        ++observed[(x[i] >> (24 - side_bits) << side_bits) + (y[i] >> (24 - side_bits))];
    return statistics::chi_square_deviate(observed, std::vector<double>(cells, static_cast<double>(x.size()) / cells));
}

inline std::vector<std::uint32_t> component(const Blocks &blocks, int which, std::size_t first = 0,
                                            std::size_t stride = 1) {
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = first; i < blocks.size(); i += stride)
        numbers.push_back(blocks[i][which]);
    return numbers;
}

} // namespace sample_numbers
