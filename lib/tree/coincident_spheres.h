// Moves apart coincident spheres of a translucent scene, for example sticks that end in the same atom.
#pragma once

#include "lib/base/work_progress.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace pt {

// A hash of a sphere's word decides whether a ray passes the sphere (opacity_generator() of shaders/tree_walk.glsl). So
// a ray would pass all spheres with equal words or none. `ways` has motions or axes, or is empty. `spheres` has scene
// indices, so that the result does not depend on the tree.
void set_coincident_apart(std::span<glm::uvec4> places, std::span<const glm::uvec4> ways,
                          std::span<const std::uint32_t> spheres, WorkProgress &progress);

} // namespace pt
