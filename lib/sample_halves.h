// Which samples belong to which half of the film. Renderer sorts the samples of a slice by this, as the kernel does.
#pragma once

#include "gpu_layout.h"

#include <cstdint>
#include <vector>

namespace pt {

// The samples of a range that belong to one half: one of each pair 2k, 2k + 1, in the order of the pairs.
struct HalfRange {
    std::uint32_t first_pair;
    std::uint32_t sample_count;
};

// How a sampler's samples are divided into halves: by a linear functional over GF(2) of their indices (gpu_layout.h).
class SampleHalves {
public:
    explicit SampleHalves(std::uint32_t sampler);

    std::uint32_t half_of(std::uint32_t index) const;

    // Of the samples [first, first + count), which end at 2^32 or before. The pairs that the range cuts through at its ends
    // make the halves differ by up to two samples.
    HalfRange range(std::uint32_t half, std::uint32_t first, std::uint32_t count) const;

    // Their indices.
    std::vector<std::uint32_t> indices(std::uint32_t half, const HalfRange &range) const;

private:
    std::uint32_t mask_;
};

// The longest range, given how many of its samples may belong to one half (>= 1).
std::uint32_t longest_range(std::uint32_t max_samples_of_half);

} // namespace pt
