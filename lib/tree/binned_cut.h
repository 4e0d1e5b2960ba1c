// Divides many spheres at a cut that is close to the best. Used to make the shape of a tree.
#pragma once

#include "lib/tree/part.h"

namespace pt {

// The two parts with the least sum of surface times expected nodes, among the cuts between bins along the longest axis
// (Wald 2007). The centres must not all be at one point; equal centres stay together.
Halves binned_halves(const Part &part);

} // namespace pt
