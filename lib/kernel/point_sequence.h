// Points of quasi-random sequences, exact, for the sampler in shaders/sampler.glsl. Renderer makes the table of a
// slice.
#pragma once

#include "shaders/gpu_layout.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace pt {

// Dimensions of a sequence. Paths that need more numbers take hashed random ones for the rest.
inline constexpr std::uint32_t sequence_dimensions = 64;

// Coordinate of the point with an index in the Sobol sequence with the direction numbers of Joe and Kuo, as a
// multiple of 2^-32. dimension < sequence_dimensions.
std::uint32_t sobol(std::uint32_t index, std::uint32_t dimension);

// Radical inverse of an index below 2^35 in the dimension-th prime base (Halton 1960), as the largest multiple of
// 2^-32 not above it.
std::uint32_t radical_inverse(std::uint64_t index, std::uint32_t dimension);

// How a row of the point table is divided (gpu_layout.h, row_blocks): into blocks of up to four dimensions, in order.
struct PointLayout {
    std::vector<std::uint32_t> block_dimensions; // how many each block has: the shared blocks, then those of a branch
    std::uint32_t shared_blocks;
    std::uint32_t branches;

    std::uint32_t block_count() const { return static_cast<std::uint32_t>(block_dimensions.size()); }
    std::uint32_t row_blocks() const { return gpu::row_blocks(block_count(), shared_blocks, branches); }

    // Whether the first block has a time beside the place in the pixel.
    bool has_time() const { return block_dimensions.front() == gpu::camera_dimensions(1); }

    // The dimensions of the first blocks.
    std::uint32_t dimensions_of(std::uint32_t blocks) const {
        return std::accumulate(block_dimensions.begin(), block_dimensions.begin() + blocks, 0U);
    }
};

// A coordinate with its binary digits scrambled as Owen does (1995): each digit is flipped or not by a hash of the
// digits before it and of the seed.
std::uint32_t owen_scrambled(std::uint32_t coordinate, std::uint32_t seed);

// A block of the table: coordinates as multiples of 2^-32, 0 beyond the block's dimensions.
using PointBlock = std::array<std::uint32_t, 4>;

// The points of samples for a sampler of pt.h that uses a sequence, as the kernel reads them: a row for each index.
// Those of Sobol are scrambled by the seed.
std::vector<PointBlock> point_table(std::uint32_t sampler, std::uint64_t seed, std::span<const std::uint32_t> indices,
                                    const PointLayout &layout);

} // namespace pt
