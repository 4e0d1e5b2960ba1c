// Divides spheres in two: few of them at the best of all cuts, many at one that is close to it. Used to make the shape
// of a tree.
#pragma once

#include "lib/tree/part.h"

#include <cstddef>

namespace pt {

// The two parts with the least sum of surface times expected nodes, among the cuts between bins along the longest axis
// (Wald 2007). The centres must not all be at one point; equal centres stay together.
Halves binned_halves(const Part &part);

// For so few spheres sorting costs less than bins.
inline constexpr std::size_t most_swept = 12;

// The same among all cuts between two of at most most_swept spheres, along each axis.
Halves swept_halves(const Part &part);

} // namespace pt
