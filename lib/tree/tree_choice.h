// Decides whether a scene has a tree, and which spheres are outside it.
#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/sphere_source.h"

#include <cstdint>
#include <vector>

namespace pt {

// From this many spheres on a tree pays, on lavapipe because longer loops are not unrolled (DevicePolicy::unrolled).
inline constexpr std::uint32_t default_tree_from = 113;

// With capsules, which take several times as long each, and seconds for lavapipe to compile.
inline constexpr std::uint32_t tree_of_others_from = 24;

std::uint32_t tree_pays_from(const SphereSource &spheres);

// Huge and distant spheres, which would make the tree's grid coarse, and few capsules. Ascending indices; each sphere
// is a unit of work.
std::vector<std::uint32_t> spheres_beside_tree(const SphereSource &spheres, WorkProgress &progress);

} // namespace pt
