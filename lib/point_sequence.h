// Points of quasi-random sequences, exact, for the sampler in shaders/sampler.glsl. Renderer makes the table of a slice.
#pragma once

#include <cstdint>
#include <vector>

namespace pt {

// Dimensions that a sequence has. Paths that need more take hashed random numbers for the rest.
inline constexpr std::uint32_t sequence_dimensions = 64;

// Coordinate of the point with an index in the Sobol sequence with the direction numbers of Joe and Kuo, as a multiple of
// 2^-32. dimension < sequence_dimensions.
std::uint32_t sobol(std::uint32_t index, std::uint32_t dimension);

// Radical inverse of an index in the dimension-th prime base (Halton 1960), as the largest multiple of 2^-32 not above it.
std::uint32_t radical_inverse(std::uint32_t index, std::uint32_t dimension);

// The coordinates of consecutive points for a sampler of pt.h that uses a sequence, as the kernel reads them: count rows of
// dimensions words, those of Sobol with their bits reversed.
std::vector<std::uint32_t> point_table(std::uint32_t sampler, std::uint32_t first_index, std::uint32_t count,
                                       std::uint32_t dimensions);

} // namespace pt
