// Which samples the two parts of a film hold. The older part has those below a split, the newer part the others; the
// split follows from the first and the last sample alone, so films of any ranges can be added in any order.
#pragma once

#include "lib/film/sample_set.h"
#include "shaders/gpu_layout.h"

#include <array>
#include <cstdint>

namespace pt {

enum FilmPart : std::uint32_t { older_part, newer_part };
static_assert(gpu::FILM_PARTS == 2);

// How many samples each part holds.
using PartCounts = std::array<std::uint64_t, gpu::FILM_PARTS>;

// Of the indices that have samples on both sides, the one with the most zeros at its end in binary, if that is a
// multiple of 8. Otherwise the next multiple of 8 from the last sample on, and then all samples are in the older part:
// fewer than 8 in a part would say next to nothing.
//
// For the samples [0, N) that is the largest power of two below N. At N = 2^k both parts are runs of 2^(k - 1) points
// that begin at a multiple of 2^(k - 1): the best sets that a sequence has.
//
// Just one index of a range has the most zeros, since between two with equally many lies one with more. So when films
// are added, each film has the split of the sum or lies wholly on one side of it. Hence two parts are enough to add
// films in any order with the same result.
std::uint64_t split_of(const SampleRange &hull);

PartCounts part_counts(const SampleSet &samples);

// Whether a sample is the first of its part. before: the range of the samples so far; split: the split with the sample.
// If the split has moved, all samples of before are on one side of it.
bool begins_part(const SampleRange &before, std::uint64_t split, std::uint64_t sample);

} // namespace pt
