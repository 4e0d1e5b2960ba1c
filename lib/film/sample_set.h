// The samples of a film, as disjoint ranges of indices, and their division into two parts: the older part has the
// samples below a split, the newer part the others. The split depends on the first and last sample only, so films of
// any ranges can be added in any order.
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

    // In ascending order, none empty, none adjacent to the next.
    const std::vector<SampleRange> &ranges() const { return ranges_; }

    bool empty() const { return ranges_.empty(); }
    std::uint64_t count() const;
    std::uint64_t count_below(std::uint64_t index) const;

    // Empty without samples.
    SampleRange hull() const;

    // The first common samples.
    std::optional<SampleRange> overlap(const SampleSet &other) const;

    // The first run of missing samples at or after an index, up to the next present one; empty if none is missing.
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

// Samples in each part.
using PartCounts = std::array<std::uint64_t, gpu::FILM_PARTS>;

// The index with the most trailing zero bits among those with samples on both sides, if it is a multiple of 8.
// Otherwise the next multiple of 8 after the last sample, and all samples are in the older part: fewer than 8 in a part
// would say next to nothing.
//
// Samples [0, N) are split at the largest power of two below N. At N = 2^k both parts are runs of 2^(k - 1) points that
// begin at a multiple of 2^(k - 1), the best sets of a sequence.
//
// A range has exactly one index with the most zeros, since between two with equally many lies one with more. So when
// films are added, each has the split of the sum or lies on one side of it. Hence two parts are enough to add films in
// any order with the same result.
std::uint64_t split_of(const SampleRange &hull);

PartCounts part_counts(const SampleSet &samples);

// Whether a sample is its part's first. before: range of the samples so far; split: with the sample included. If the
// split moves, all samples of `before` are on one side of it.
bool begins_part(const SampleRange &before, std::uint64_t split, std::uint64_t sample);

} // namespace pt
