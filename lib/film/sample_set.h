// Which samples of a sequence a film holds: disjoint ranges of absolute indices.
#pragma once

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
    std::optional<SampleRange> overlap(const SampleRange &range) const;
    std::optional<SampleRange> overlap(const SampleSet &other) const;

    // The first samples from an index on that are not in the set, up to the next that is; empty if all are.
    SampleRange next_missing(std::uint64_t from) const;

    // Samples that are added must not be there yet, samples that are removed must be.
    void add(const SampleRange &range);
    void add(const SampleSet &other);
    void remove(const SampleRange &range);

    bool operator==(const SampleSet &) const = default;

private:
    std::vector<SampleRange> ranges_;
};

// "[0, 64), [128, 256)"
std::string text_of(const SampleSet &samples);

} // namespace pt
