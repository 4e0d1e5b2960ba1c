// Divides few spheres at the best of all cuts between two of them. Used to make the shape of a tree.
#pragma once

#include "lib/tree/part.h"

#include <cstddef>

namespace pt {

// For so few spheres sorting costs less than bins, which work for any number (binned_cut.h).
inline constexpr std::size_t most_swept = 12;

// The two parts of two to most_swept spheres with the least sum of surface times expected nodes. The centres must not
// all be at one point; equal centres stay together.
Halves swept_halves(const Part &part);

} // namespace pt
