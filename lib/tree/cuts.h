// Divides spheres in two: few at the best of all cuts, many at nearly the best.
#pragma once

#include "lib/tree/part.h"

#include <cstddef>

namespace pt {

// The halves with the least sum of surface times expected nodes, among cuts between bins along the longest axis (Wald
// 2007). Requires different centers; equal ones stay together.
Halves binned_halves(const Part &part);

// Up to here sorting costs less than bins.
inline constexpr std::size_t most_swept = 12;

// Tries all cuts along each axis, for at most most_swept spheres.
Halves swept_halves(const Part &part);

} // namespace pt
