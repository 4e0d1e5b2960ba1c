#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/sphere_source.h"

#include <cstdint>
#include <vector>

namespace pt {

// A tree is faster from this many spheres on: DevicePolicy::unrolled + 1, because lavapipe does not unroll longer
// loops.
inline constexpr std::uint32_t default_tree_from = 113;

// The same limit if there are capsules, whose tests take several times as long. lavapipe takes seconds to compile these
// tests.
inline constexpr std::uint32_t tree_of_others_from = 24;

std::uint32_t tree_pays_from(const SphereSource &spheres);

// Returns distant spheres and, if there are few, capsules. Indices are ascending. Each sphere is a unit of work.
std::vector<std::uint32_t> spheres_beside_tree(const SphereSource &spheres, WorkProgress &progress);

} // namespace pt
