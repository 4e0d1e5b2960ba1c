// Which samples the two parts of the film hold; see sample_parts.h.
#include "lib/film/sample_parts.h"

#include <algorithm>
#include <bit>

namespace pt {

PartCounts part_counts(std::uint32_t sample_count) {
    if (sample_count <= min_older_samples)
        return {sample_count, 0};
    const std::uint32_t older = std::bit_floor(sample_count - 1);
    return {older, sample_count - older};
}

std::uint32_t part_of(std::uint32_t sample) {
    return sample < min_older_samples ? 0 : 1;
}

std::uint32_t end_of_part(std::uint32_t sample) {
    const std::uint64_t end = std::max<std::uint64_t>(2 * std::uint64_t{std::bit_floor(sample)}, min_older_samples);
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(end, UINT32_MAX));
}

} // namespace pt
