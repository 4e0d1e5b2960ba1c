// Divides few spheres where that is best, of all places between two of them. Used to make the shape of a tree.
#pragma once

#include "lib/tree/part.h"

#include <cstddef>

namespace pt {

// So few that to sort them costs less than bins, which are for any number (binned_cut.h).
inline constexpr std::size_t most_swept = 12;

// Of two to most_swept spheres whose centres are not all at one point: the two parts for which surface times nodes to
// come, summed up, is least. Centres that are equal stay together.
Halves swept_halves(const Part &part);

} // namespace pt
