// Spheres that a tree's grid would have to be coarse for: huge ones, like a ground, and far ones, like a sun.
#pragma once

#include "lib/scene/sphere_source.h"

#include <cstdint>
#include <vector>

namespace pt {

// Of the few that reach farthest from the middle of the scene, those that reach 16 times as far as what is not among the
// few. Indices in ascending order.
std::vector<std::uint32_t> outlying_spheres(const SphereSource &spheres);

} // namespace pt
