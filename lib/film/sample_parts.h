// Which samples the two parts of the film hold. They are numbered from 0 in the order in which they are taken: part 0
// holds the older ones, part 1 those since, and when as many are there as before, the parts are folded into one.
#pragma once

#include "shaders/gpu_layout.h"

#include <array>
#include <cstdint>

namespace pt {

// Samples that part 0 takes at first: with fewer, the parts would say next to nothing.
inline constexpr std::uint32_t min_older_samples = 8;

// How many samples each part holds.
using PartCounts = std::array<std::uint32_t, gpu::FILM_PARTS>;

// Of a number of samples: up to 8 are all in part 0, of more it has the largest power of two below that number. At 2^k
// samples each part has a half of them; both are runs of 2^(k - 1) points, the best sets that a sequence has.
PartCounts part_counts(std::uint32_t sample_count);

// The part to which a sample is added.
std::uint32_t part_of(std::uint32_t sample);

// The end of the samples after it that are added to the same part without a fold in between, at most 2^32 - 1.
std::uint32_t end_of_part(std::uint32_t sample);

} // namespace pt
