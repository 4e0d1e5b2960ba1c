// The samples of a film, as disjoint ranges of indices. A split divides them into an older and a newer part. It depends
// on the first and last sample only, so films of any ranges can be added in any order.
#pragma once

#include "shaders/gpu_layout.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pt {

// Sample indices are below this.
inline constexpr std::uint64_t sample_index_end = std::uint64_t{1} << 32;

struct SampleRange {
    std::uint64_t first = 0;
    std::uint64_t end = 0;

    std::uint64_t count() const { return end - first; }
    bool empty() const { return first == end; }
    bool operator==(const SampleRange &) const = default;
};

// The smallest range that contains both.
SampleRange hull_of(const SampleRange &a, const SampleRange &b);

// "[0, 64)"
std::string text_of(const SampleRange &range);

class SampleSet {
public:
    SampleSet() = default;
    explicit SampleSet(const SampleRange &range) { add(range); }

    // Ascending, none empty, none adjacent to the next.
    const std::vector<SampleRange> &ranges() const { return ranges_; }

    bool empty() const { return ranges_.empty(); }
    std::uint64_t count() const;
    std::uint64_t count_below(std::uint64_t index) const;

    // Empty without samples.
    SampleRange hull() const;

    std::optional<SampleRange> overlap(const SampleSet &other) const;

    // The first run of missing samples at or after an index; empty if none is missing.
    SampleRange next_missing(std::uint64_t from) const;

    // The samples must be missing so far.
    void add(const SampleRange &range);
    void add(const SampleSet &other);

    bool operator==(const SampleSet &) const = default;

private:
    std::vector<SampleRange> ranges_;
};

// "[0, 64), [128, 256)"
std::string text_of(const SampleSet &samples);

enum FilmPart : std::uint32_t { older_part, newer_part };
static_assert(gpu::FILM_PARTS == 2);

using PartCounts = std::array<std::uint64_t, gpu::FILM_PARTS>;

// The index with most trailing zero bits among those with samples on both sides, if it is a multiple of 8. Otherwise
// the next multiple of 8 after the last sample: a part of fewer than 8 would hardly show an error.
//
// At N = 2^k, [0, N) splits into runs of 2^(k - 1) points that begin at a multiple of 2^(k - 1), a sequence's best
// sets.
//
// The index is unique, since between two with equally many zeros lies one with more. So each added film has the sum's
// split or lies on one side of it: two parts suffice.
std::uint64_t split_of(const SampleRange &hull);

PartCounts part_counts(const SampleSet &samples);

// Whether a sample is its part's first. before: range of the samples so far. split: with the sample included.
bool begins_part(const SampleRange &before, std::uint64_t split, std::uint64_t sample);

} // namespace pt
