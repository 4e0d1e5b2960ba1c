// Points of quasi-random sequences, exact, for the sampler in shaders/sampler.glsl. Renderer makes the table of a slice.
#pragma once

#include "gpu_layout.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// Dimensions that a sequence has. Paths that need more take hashed random numbers for the rest.
inline constexpr std::uint32_t sequence_dimensions = 64;

// Coordinate of the point with an index in the Sobol sequence with the direction numbers of Joe and Kuo, as a multiple of
// 2^-32. dimension < sequence_dimensions.
std::uint32_t sobol(std::uint32_t index, std::uint32_t dimension);

// The dimension-th prime, from 2 on: the base of radical inverses. dimension < sequence_dimensions.
std::uint32_t prime_base(std::uint32_t dimension);

// Radical inverse of an index below 2^35 in the dimension-th prime base (Halton 1960), as the largest multiple of 2^-32 not
// above it.
std::uint32_t radical_inverse(std::uint64_t index, std::uint32_t dimension);

// What a row of the point table consists of (gpu_layout.h, row_words).
struct PointLayout {
    std::uint32_t dimensions; // in all
    std::uint32_t shared;     // of them shared by the branches of a sample
    std::uint32_t branches;

    std::uint32_t row_words() const { return gpu::row_words(dimensions, shared, branches); }
};

// The points of samples for a sampler of pt.h that uses a sequence, as the kernel reads them: a row for each index,
// coordinates of Sobol with their bits reversed.
std::vector<std::uint32_t> point_table(std::uint32_t sampler, std::span<const std::uint32_t> indices,
                                       const PointLayout &layout);

} // namespace pt
