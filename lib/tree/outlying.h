// Spheres that a tree's grid would have to be coarse for: huge ones, like a ground, and far ones, like a sun.
#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/sphere_source.h"

#include <cstdint>
#include <vector>

namespace pt {

// Of the few that reach farthest from the middle of the scene, those that reach 16 times as far as what is not among
// the few. Indices in ascending order. Each sphere is a unit of work.
std::vector<std::uint32_t> outlying_spheres(const SphereSource &spheres, WorkProgress &progress);

} // namespace pt
