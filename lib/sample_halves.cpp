// Which samples belong to which half of the film; see sample_halves.h.
#include "sample_halves.h"

#include <bit>

namespace pt {

static_assert((gpu::half_mask(gpu::SAMPLER_SOBOL) & gpu::half_mask(gpu::SAMPLER_HALTON) & 1) == 1,
              "each half has one sample of a pair");

SampleHalves::SampleHalves(std::uint32_t sampler) : mask_(gpu::half_mask(sampler)) {}

std::uint32_t SampleHalves::half_of(std::uint32_t index) const {
    return static_cast<std::uint32_t>(std::popcount(index & mask_)) & 1U;
}

HalfRange SampleHalves::range(std::uint32_t half, std::uint32_t first, std::uint32_t count) const {
    // The half's first pair at or after an index: if the index cuts a pair, the half's sample may be the one before it.
    const auto pair_from = [&](std::uint64_t index) {
        const std::uint64_t pair = index / 2;
        const bool cut = index % 2 == 1;
        return cut && half_of(static_cast<std::uint32_t>(2 * pair)) == half ? pair + 1 : pair;
    };
    const std::uint64_t begin = pair_from(first);
    const std::uint64_t end = pair_from(std::uint64_t{first} + count);
    return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)};
}

std::vector<std::uint32_t> SampleHalves::indices(std::uint32_t half, const HalfRange &range) const {
    std::vector<std::uint32_t> indices(range.sample_count);
    for (std::uint32_t i = 0; i < range.sample_count; ++i) {
        const std::uint32_t even = 2 * (range.first_pair + i);
        indices[i] = even | (half_of(even) ^ half);
    }
    return indices;
}

std::uint32_t longest_range(std::uint32_t max_samples_of_half) {
    // A range of 2m - 1 samples cuts one pair, so no half has more than (m - 1) + 1; one of 2m may cut two.
    return 2 * max_samples_of_half - 1;
}

} // namespace pt
