#pragma once

#include "lib/film/sample_set.h"

#include <cstdint>
#include <span>

namespace pt {

struct TileSlice {
    std::span<const std::uint32_t> tiles;
    SampleRange before; // hull of the tiles' present samples; may be empty
    SampleRange samples;
    bool takes; // false: another device takes the samples

    std::uint64_t split() const { return split_of(hull_of(before, samples)); }

    bool moves_split() const { return !before.empty() && split_of(before) != split(); }
};

} // namespace pt
