// Spheres of a translucent scene that take up the same space, but differ in color or material. Used by SphereTree.
#pragma once

#include "lib/base/work_progress.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace pt {

// Moves such spheres apart by steps of the grid. Rays pass a sphere by the numbers of its place (opacity_generator() of
// shaders/tree_walk.glsl), so equal places would let all or none of them pass. places: of the tree's spheres; ways:
// likewise, or empty; spheres: their indices in the scene, in whose order they are moved farther and farther.
void set_coincident_apart(std::span<glm::uvec4> places, std::span<const glm::uvec4> ways,
                          std::span<const std::uint32_t> spheres, WorkProgress &progress);

} // namespace pt
