#pragma once

#include "lib/tree/part.h"

#include <cstddef>

namespace pt {

// Returns the halves with the least sum of surface * expected nodes (Wald 2007). Cuts are between bins along the
// longest axis. The centers must not all be equal. Spheres with equal centers stay together.
PartHalves binned_halves(const Part &part);

inline constexpr std::size_t most_swept = 12;

// Tries all cuts along each axis, for at most most_swept spheres.
PartHalves swept_halves(const Part &part);

} // namespace pt
