// How large balls are to be where nothing says it.
#pragma once

#include <span>

namespace cli {

// Half of the distance to the nearest neighbour, its median over some particles: then most balls just touch. Points
// that nothing keeps apart, as of a scanned surface or a galaxy, are near some neighbour by chance: with half of the
// distance to the fourth they nearly close a surface. 1 where no two are apart. positions: x, y, z of each.
double typical_radius(std::span<const double> positions);

} // namespace cli
