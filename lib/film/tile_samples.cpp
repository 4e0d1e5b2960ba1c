#include "lib/film/tile_samples.h"

#include <algorithm>
#include <utility>

namespace pt {

namespace {

constexpr std::uint32_t no_set = UINT32_MAX;

} // namespace

bool TileSamples::empty() const {
    return std::ranges::all_of(sets_, [](const SampleSet &set) { return set.empty(); });
}

std::uint64_t TileSamples::least() const {
    std::uint64_t least = of(0).count();
    for (const std::uint32_t set : set_of_)
        least = std::min(least, sets_[set].count());
    return least;
}

std::uint64_t TileSamples::most() const {
    std::uint64_t most = of(0).count();
    for (const std::uint32_t set : set_of_)
        most = std::max(most, sets_[set].count());
    return most;
}

std::uint64_t TileSamples::total() const {
    if (even())
        return sets_.front().count() * grid_.width * grid_.height;
    std::uint64_t total = 0;
    for (std::size_t tile = 0; tile < set_of_.size(); ++tile)
        total += of(tile).count() * grid_.pixels(tile).pixel_count();
    return total;
}

void TileSamples::tell_apart() {
    if (even())
        set_of_.assign(grid_.count(), 0);
}

std::uint32_t TileSamples::index_of(SampleSet samples) {
    const auto found = std::ranges::find(sets_, samples);
    if (found != sets_.end())
        return static_cast<std::uint32_t>(found - sets_.begin());
    sets_.push_back(std::move(samples));
    return static_cast<std::uint32_t>(sets_.size() - 1);
}

void TileSamples::add(std::span<const std::uint32_t> tiles, const SampleRange &range) {
    if (tiles.size() == grid_.count() && even()) {
        sets_.front().add(range);
        return;
    }
    tell_apart();
    std::vector<std::uint32_t> extended(sets_.size(), no_set);
    for (const std::uint32_t tile : tiles) {
        std::uint32_t &set = set_of_[tile];
        if (extended[set] == no_set) {
            SampleSet samples = sets_[set];
            samples.add(range);
            extended[set] = index_of(std::move(samples));
        }
        set = extended[set];
    }
}

void TileSamples::set(std::size_t tile, const SampleSet &samples) {
    tell_apart();
    set_of_[tile] = index_of(samples);
}

TileSamples TileSamples::rows(std::uint32_t first_row, std::uint32_t row_count) const {
    TileSamples part({grid_.width, row_count});
    part.sets_ = sets_;
    if (!even()) {
        const auto first = set_of_.begin() + static_cast<std::ptrdiff_t>(grid_.tile_at(0, first_row));
        part.set_of_.assign(first, first + static_cast<std::ptrdiff_t>(part.grid_.count()));
    }
    return part;
}

void TileSamples::clear() noexcept {
    sets_.erase(sets_.begin() + 1, sets_.end());
    sets_.front() = SampleSet();
    set_of_.clear();
}

void TileSamples::tidy() {
    if (even())
        return;
    std::vector<SampleSet> used;
    std::vector<std::uint32_t> places(sets_.size(), no_set);
    for (std::uint32_t &set : set_of_) {
        if (places[set] == no_set) {
            places[set] = static_cast<std::uint32_t>(used.size());
            used.push_back(sets_[set]);
        }
        set = places[set];
    }
    sets_ = std::move(used);
    if (sets_.size() == 1)
        set_of_.clear();
}

} // namespace pt
