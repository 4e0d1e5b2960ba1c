// How large balls are to be where nothing says it.
#pragma once

#include <span>

namespace cli {

// Half of the distance to the nearest neighbour, its median over some particles: then most balls just touch. 1 where no
// two are apart. positions: x, y, z of each.
double typical_radius(std::span<const double> positions);

} // namespace cli
