// Divides many spheres where that is about best. Used to make the shape of a tree.
#pragma once

#include "lib/tree/part.h"

namespace pt {

// Of spheres whose centres are not all at one point: the two parts for which surface times nodes to come, summed up, is
// least, sought between bins of the longest axis (Wald 2007). Centres that are equal stay together.
Halves binned_halves(const Part &part);

} // namespace pt
