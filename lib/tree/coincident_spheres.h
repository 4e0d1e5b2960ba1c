// Separates spheres of a translucent scene that share a word, such as the sticks of an atom. Used by SphereTree.
#pragma once

#include "lib/base/work_progress.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace pt {

// Moves such spheres apart by grid steps. The number by which rays pass a sphere is a hash of its word
// (opacity_generator() of shaders/tree_walk.glsl), so equal words would let all or none of them pass. places: words
// with the centers' grid places. ways: motions or axes, or empty. spheres: indices in the scene. Spheres that share a
// word move farther the later they come, by ways, then indices.
void set_coincident_apart(std::span<glm::uvec4> places, std::span<const glm::uvec4> ways,
                          std::span<const std::uint32_t> spheres, WorkProgress &progress);

} // namespace pt
