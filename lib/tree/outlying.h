// Spheres that a tree's grid would have to be coarse for: huge ones, like a ground, and far ones, like a sun.
#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/sphere_source.h"

#include <cstdint>
#include <vector>

namespace pt {

// The few spheres that reach 16 times as far from the middle of the scene as all others. Indices in ascending order.
// Each sphere is a unit of work.
std::vector<std::uint32_t> outlying_spheres(const SphereSource &spheres, WorkProgress &progress);

} // namespace pt
