// Which samples of a sequence a film holds: disjoint ranges of absolute indices; and which of them each of its two
// parts has. The older part has those below a split, the newer part the others; the split follows from the first and
// the last sample alone, so films of any ranges can be added in any order.
#pragma once

#include "shaders/gpu_layout.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pt {

// Indices of samples are below this.
inline constexpr std::uint64_t sample_index_end = std::uint64_t{1} << 32;

// The indices [first, end).
struct SampleRange {
    std::uint64_t first = 0;
    std::uint64_t end = 0;

    std::uint64_t count() const { return end - first; }
    bool empty() const { return first == end; }
    bool operator==(const SampleRange &) const = default;
};

// The smallest range that has the samples of both.
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

    // From the first sample to the last; empty if there is none.
    SampleRange hull() const;

    // The first samples that are in both.
    std::optional<SampleRange> overlap(const SampleSet &other) const;

    // The first samples from an index on that are not in the set, up to the next that is; empty if all are.
    SampleRange next_missing(std::uint64_t from) const;

    // Samples that are added must not be there yet.
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
