#include "lib/film/film_parts.h"

#include <algorithm>
#include <bit>

namespace pt {

namespace {

constexpr std::uint64_t min_part = 8; // samples

// The smallest multiple from an index on.
std::uint64_t multiple_from(std::uint64_t index, std::uint64_t factor) {
    return (index + factor - 1) / factor * factor;
}

} // namespace

// Of two numbers the common leading digits, a one, and zeros: no other number above the first, and not above the
// second, ends with as many zeros.
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

std::uint64_t end_of_run(const SampleRange &hull, std::uint64_t sample) {
    const SampleRange with_sample = hull_of(hull, {sample, sample + 1});
    const std::uint64_t split = split_of(with_sample);
    if (sample < split)
        return split;
    const std::uint64_t more_zeros = 2 * (split & ~(split - 1));
    return multiple_from(with_sample.end, more_zeros);
}

bool begins_part(const SampleRange &before, std::uint64_t split, std::uint64_t sample) {
    return before.empty() || (sample < split ? split <= before.first : before.end <= split);
}

void PartUse::extend(const SampleRange &range) {
    const std::uint64_t before = split();
    const bool folded = needs_fold(range);
    hull_ = hull_of(hull_, range);
    if (folded)
        older_ = before < split() ? 0 : 1;
    holds_samples_ = true;
}

} // namespace pt
