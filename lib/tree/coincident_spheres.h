// Moves apart coincident spheres of a translucent scene, such as the sticks that meet in an atom.
#pragma once

#include "lib/base/work_progress.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace pt {

// Hashes of words decide which spheres let a ray pass (opacity_generator() of shaders/tree_walk.glsl). If spheres had
// equal words, a ray would pass all of them or none. `ways` has motions or axes, or is empty. `spheres` has scene
// indices, so the result does not depend on the tree.
void set_coincident_apart(std::span<glm::uvec4> places, std::span<const glm::uvec4> ways,
                          std::span<const std::uint32_t> spheres, WorkProgress &progress);

} // namespace pt
