// Moves apart the spheres of a translucent scene that share a word, such as the sticks of an atom.
#pragma once

#include "lib/base/work_progress.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace pt {

// Hashes of words decide which spheres let a ray pass (opacity_generator() of shaders/tree_walk.glsl), so equal words
// would let all pass or none. places: words with the centers' grid places. ways: motions or axes, or empty. spheres:
// scene indices. Later spheres, by ways and then indices, move farther.
void set_coincident_apart(std::span<glm::uvec4> places, std::span<const glm::uvec4> ways,
                          std::span<const std::uint32_t> spheres, WorkProgress &progress);

} // namespace pt
