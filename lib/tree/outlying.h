// Spheres that would make the grid of a tree coarse: huge ones, like a ground, and distant ones, like a sun.
#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/sphere_source.h"

#include <cstdint>
#include <vector>

namespace pt {

// The few spheres that reach 16 times as far from the middle of the scene as all others, by index in ascending order.
// Each sphere is a unit of work.
std::vector<std::uint32_t> outlying_spheres(const SphereSource &spheres, WorkProgress &progress);

} // namespace pt
