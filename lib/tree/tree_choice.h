// Whether a scene has a tree, and which spheres are not in it.
#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/sphere_source.h"

#include <cstdint>
#include <vector>

namespace pt {

// From this many spheres on, nearly all of them are in a tree. On lavapipe loops are no longer unrolled from there on
// (DevicePolicy::unrolled). On an H200 a tree is as fast as testing each sphere from 160 on with three vertices, and
// from 115 on with six.
inline constexpr std::uint32_t default_tree_from = 113;

// Where some surfaces are no balls, testing each takes several times as long, and on lavapipe the kernel of a list is
// compiled for seconds: 24 took as long either way, 84 in a list 2.8 times as long (a box of 12 edges).
inline constexpr std::uint32_t tree_of_others_from = 24;

// How many spheres that the camera may see make a tree pay.
std::uint32_t tree_pays_from(const SphereSource &spheres);

// The spheres that are better tested one by one: huge and distant ones, which would make the grid of a tree coarse, and
// those that are no balls if they are few. By index in ascending order; each sphere is a unit of work.
std::vector<std::uint32_t> spheres_beside_tree(const SphereSource &spheres, WorkProgress &progress);

} // namespace pt
