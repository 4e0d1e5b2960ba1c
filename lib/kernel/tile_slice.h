// Samples of some tiles of a film: as many as go into one submission.
#pragma once

#include "lib/film/sample_set.h"

#include <cstdint>
#include <span>

namespace pt {

struct TileSlice {
    std::span<const std::uint32_t> tiles; // ascending
    SampleRange before;                   // from the first to the last sample that they have; empty if they have none
    SampleRange samples;
    bool takes; // them, instead of making room for them alone: where another device takes them

    std::uint64_t split() const { return split_of(hull_of(before, samples)); }

    // Whether the parts of these tiles are folded first.
    bool moves_split() const { return !before.empty() && split_of(before) != split(); }
};

} // namespace pt
