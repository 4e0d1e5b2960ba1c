#pragma once

#include "shaders/gpu_layout.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace pt {

// Numbers beyond these dimensions are random.
inline constexpr std::uint32_t sequence_dimensions = 64;

std::uint32_t sobol(std::uint32_t index, std::uint32_t dimension);

// The coordinate of Halton's sequence (1960) in units of 2^-32, rounded down. Requires index < 2^35.
std::uint32_t radical_inverse(std::uint64_t index, std::uint32_t dimension);

// The blocks of a row of the point table (row_blocks() in gpu_layout.h).
struct PointLayout {
    std::vector<std::uint32_t> block_dimensions; // dimensions of the shared blocks, then of a branch
    std::uint32_t shared_blocks;
    std::uint32_t branches;

    std::uint32_t block_count() const { return static_cast<std::uint32_t>(block_dimensions.size()); }
    std::uint32_t row_blocks() const { return gpu::row_blocks(block_count(), shared_blocks, branches); }

    bool has_time() const { return block_dimensions.front() == gpu::camera_dimensions(1); }

    std::uint32_t dimensions_of(std::uint32_t blocks) const {
        return std::accumulate(block_dimensions.begin(), block_dimensions.begin() + blocks, 0U);
    }
};

// Flips each binary digit by a hash of the seed and of the digits before (Owen 1995).
std::uint32_t owen_scrambled(std::uint32_t coordinate, std::uint32_t seed);

using PointBlock = std::array<std::uint32_t, 4>;

// Returns a row for each index. The sampler must not be PT_SAMPLER_RANDOM. The seed scrambles Sobol points.
std::vector<PointBlock> point_table(std::uint32_t sampler, std::uint64_t seed, std::span<const std::uint32_t> indices,
                                    const PointLayout &layout);

} // namespace pt
