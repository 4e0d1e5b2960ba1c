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

// The index with the most zeros at its end that has samples on both sides, if it is a multiple of 8; else the next
// multiple of 8 from the last sample on, and all samples are older: fewer than 8 in a part would say next to nothing.
//
// Of the samples [0, N) it is the largest power of two below N. At N = 2^k both parts are runs of 2^(k - 1) points that
// begin at a multiple of 2^(k - 1): the best sets that a sequence has.
//
// Among the indices within a range just one has the most zeros, since between two with equally many lies one with more.
// So the split of a film that is made of others either is the split of one of them too, or that one lies on one side of
// it as a whole. Two parts for each film are all that is needed to add films in any order with the same result.
std::uint64_t split_of(const SampleRange &hull);

PartCounts part_counts(const SampleSet &samples);

// The end of the samples from an index on that can be added to a film one after the other while neither the part that
// they belong to nor the split changes. hull: of the samples before.
std::uint64_t end_of_run(const SampleRange &hull, std::uint64_t sample);

// Whether a sample is added to a part that has none yet. before: from the first to the last that the film has; split:
// with the sample. Where the split has moved, all samples of before are on one side of it.
bool begins_part(const SampleRange &before, std::uint64_t split, std::uint64_t sample);

// How the parts of a film in a device's memory are used: the older part may be either. Where the split moves, one part
// is folded into the other first.
class PartUse {
public:
    bool empty() const { return !holds_samples_; }
    std::uint64_t split() const { return split_of(hull_); }

    // From the first to the last of the samples; empty if there are none.
    SampleRange hull() const { return holds_samples_ ? hull_ : SampleRange{}; }

    // Whether samples within this range can be added only after part 1 has been added to part 0 and emptied.
    bool needs_fold(const SampleRange &range) const {
        return holds_samples_ && split_of(hull_of(hull_, range)) != split();
    }

    // Samples are added within this range, after a fold if it takes one.
    void extend(const SampleRange &range);

    // Where tiles of the film have samples of their own, and so splits: all samples lie within this range, and the
    // parts in memory stay what they are.
    void cover(const SampleRange &hull) {
        hull_ = hull;
        holds_samples_ = !hull.empty();
    }

    // The part in memory with the older samples, and that of a sample within the range so far.
    std::uint32_t older() const { return older_; }
    std::uint32_t part_of(std::uint64_t sample) const { return sample < split() ? older_ : 1 - older_; }

private:
    SampleRange hull_; // of the samples of all films that are rendered together
    std::uint32_t older_ = 0;
    bool holds_samples_ = false;
};

} // namespace pt
