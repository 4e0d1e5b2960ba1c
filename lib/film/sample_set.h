// The samples of a film, as disjoint ranges of indices. A split divides them into an older and a newer part. The split
// depends only on the first and the last sample, so films of any ranges can be added in any order.
#pragma once

#include "shaders/gpu_layout.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pt {

inline constexpr std::uint64_t sample_index_end = std::uint64_t{1} << 32;

struct SampleRange {
    std::uint64_t first = 0;
    std::uint64_t end = 0;

    std::uint64_t count() const { return end - first; }
    bool empty() const { return first == end; }
    bool operator==(const SampleRange &) const = default;
};

SampleRange hull_of(const SampleRange &a, const SampleRange &b);

std::string text_of(const SampleRange &range);

class SampleSet {
public:
    SampleSet() = default;
    explicit SampleSet(const SampleRange &range) { add(range); }

    const std::vector<SampleRange> &ranges() const { return ranges_; }

    bool empty() const { return ranges_.empty(); }
    std::uint64_t count() const;
    std::uint64_t count_below(std::uint64_t index) const;

    SampleRange hull() const;

    std::optional<SampleRange> overlap(const SampleSet &other) const;

    SampleRange next_missing(std::uint64_t from) const;

    // The set must not have these samples yet.
    void add(const SampleRange &range);
    void add(const SampleSet &other);

    bool operator==(const SampleSet &) const = default;

private:
    std::vector<SampleRange> ranges_;
};

std::string text_of(const SampleSet &samples);

enum FilmPart : std::uint32_t { older_part, newer_part };
static_assert(gpu::FILM_PARTS == 2);

using PartCounts = std::array<std::uint64_t, gpu::FILM_PARTS>;

// Returns the index with the most trailing zero bits among all that have samples on both sides, if this index is a
// multiple of 8. Otherwise returns the next multiple of 8 after the last sample, because parts of fewer than 8 samples
// hardly show an error.
std::uint64_t split_of(const SampleRange &hull);

PartCounts part_counts(const SampleSet &samples);

// Whether the sample is the first of its part. `before` is the hull of the earlier samples. `split` is split_of() for
// the hull of these samples and this one.
bool begins_part(const SampleRange &before, std::uint64_t split, std::uint64_t sample);

} // namespace pt
