#include "lib/film/film_parts.h"

#include <algorithm>
#include <bit>

namespace pt {

namespace {

constexpr std::uint64_t min_part = 8; // samples

// The smallest multiple that is not below an index.
std::uint64_t multiple_from(std::uint64_t index, std::uint64_t factor) {
    return (index + factor - 1) / factor * factor;
}

} // namespace

// The common leading digits of two numbers, then a one, then zeros: no other number above the first and up to the
// second ends with as many zeros.
std::uint64_t split_of(const SampleRange &hull) {
    if (hull.count() < 2)
        return multiple_from(hull.end, min_part);
    const std::uint64_t last = hull.end - 1;
    const std::uint64_t split = last & ~(std::bit_floor(hull.first ^ last) - 1);
    return split % min_part == 0 ? split : multiple_from(hull.end, min_part);
}

PartCounts part_counts(const SampleSet &samples) {
    const std::uint64_t older = samples.count_below(split_of(samples.hull()));
    return {older, samples.count() - older};
}

bool begins_part(const SampleRange &before, std::uint64_t split, std::uint64_t sample) {
    return before.empty() || (sample < split ? split <= before.first : before.end <= split);
}

} // namespace pt
