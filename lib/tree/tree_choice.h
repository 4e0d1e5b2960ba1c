// Decides whether a scene has a tree, and which spheres are outside it.
#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/sphere_source.h"

#include <cstdint>
#include <vector>

namespace pt {

// From this many spheres on, nearly all are in a tree. lavapipe's loops are no longer unrolled from there on
// (DevicePolicy::unrolled); on GPUs a tree pays at about the same number.
inline constexpr std::uint32_t default_tree_from = 113;

// The same if some surfaces are no balls: testing each then takes several times as long, and on lavapipe the kernel of
// a list takes seconds to compile.
inline constexpr std::uint32_t tree_of_others_from = 24;

// The number of visible spheres from which a tree pays.
std::uint32_t tree_pays_from(const SphereSource &spheres);

// Spheres better tested one by one: huge and distant ones, which would make the tree's grid coarse, and a few that are
// no balls. Ascending indices; each sphere is a unit of work.
std::vector<std::uint32_t> spheres_beside_tree(const SphereSource &spheres, WorkProgress &progress);

} // namespace pt
