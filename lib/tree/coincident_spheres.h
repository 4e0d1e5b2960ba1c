// Moves apart coincident spheres of a translucent scene, such as the sticks that meet in an atom.
#pragma once

#include "lib/base/work_progress.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace pt {

// Hashes of words decide which spheres let a ray pass (opacity_generator() of shaders/tree_walk.glsl). With equal
// words, all spheres would pass it or none. `places` are place words, `ways` motions or axes, or empty. `spheres` are
// scene indices. Equal spheres are ordered by index, so the result does not depend on the tree.
void set_coincident_apart(std::span<glm::uvec4> places, std::span<const glm::uvec4> ways,
                          std::span<const std::uint32_t> spheres, WorkProgress &progress);

} // namespace pt
