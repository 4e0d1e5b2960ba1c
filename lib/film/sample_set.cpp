#include "lib/film/sample_set.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <iterator>

namespace pt {

namespace {

constexpr std::uint64_t min_part = 8;

std::uint64_t multiple_from(std::uint64_t index, std::uint64_t factor) {
    return (index + factor - 1) / factor * factor;
}

} // namespace

SampleRange hull_of(const SampleRange &a, const SampleRange &b) {
    if (a.empty() || b.empty())
        return a.empty() ? b : a;
    return {std::min(a.first, b.first), std::max(a.end, b.end)};
}

std::string text_of(const SampleRange &range) {
    return '[' + std::to_string(range.first) + ", " + std::to_string(range.end) + ')';
}

std::uint64_t SampleSet::count() const {
    return count_below(sample_index_end);
}

std::uint64_t SampleSet::count_below(std::uint64_t index) const {
    std::uint64_t count = 0;
    for (const SampleRange &range : ranges_)
        count += std::clamp(index, range.first, range.end) - range.first;
    return count;
}

SampleRange SampleSet::hull() const {
    return empty() ? SampleRange{} : SampleRange{ranges_.front().first, ranges_.back().end};
}

std::optional<SampleRange> SampleSet::overlap(const SampleSet &other) const {
    auto own = ranges_.begin();
    for (const SampleRange &range : other.ranges_) {
        while (own != ranges_.end() && own->end <= range.first)
            ++own;
        if (own != ranges_.end() && own->first < range.end)
            return SampleRange{std::max(own->first, range.first), std::min(own->end, range.end)};
    }
    return std::nullopt;
}

SampleRange SampleSet::next_missing(std::uint64_t from) const {
    for (const SampleRange &range : ranges_) {
        if (from < range.first)
            return {from, range.first};
        from = std::max(from, range.end);
    }
    return {from, std::max(from, sample_index_end)};
}

void SampleSet::add(const SampleRange &range) {
    if (range.empty())
        return;
    const auto place = std::ranges::upper_bound(ranges_, range.first, {}, &SampleRange::first);
    assert(place == ranges_.end() || range.end <= place->first);
    assert(place == ranges_.begin() || (place - 1)->end <= range.first);
    const auto added = ranges_.insert(place, range);
    if (const auto next = added + 1; next != ranges_.end() && next->first == added->end) {
        added->end = next->end;
        ranges_.erase(next);
    }
    if (added != ranges_.begin() && (added - 1)->end == added->first) {
        (added - 1)->end = added->end;
        ranges_.erase(added);
    }
}

void SampleSet::add(const SampleSet &other) {
    assert(!overlap(other));
    std::vector<SampleRange> all;
    std::ranges::merge(ranges_, other.ranges_, std::back_inserter(all), {}, &SampleRange::first, &SampleRange::first);
    ranges_.clear();
    for (const SampleRange &range : all)
        if (!ranges_.empty() && ranges_.back().end == range.first)
            ranges_.back().end = range.end;
        else
            ranges_.push_back(range);
}

std::string text_of(const SampleSet &samples) {
    std::string text;
    for (const SampleRange &range : samples.ranges())
        text += (text.empty() ? "" : ", ") + text_of(range);
    return text;
}

// The index in (first, last] with the most trailing zeros begins with the bits that first and last share; then it has a
// one, then zeros.
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
