// The tree of lamps in the words of the scene buffer (shaders/gpu_layout.h).
#pragma once

#include "lib/scene/seen_sphere.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// From so many lamps on, the kernel chooses among them by a tree. (Measured on lavapipe, but for the rays: as fast as
// looking at all of them with 24 lamps, a third faster with 32.)
constexpr std::uint32_t least_tree_lamps = 32;

// Of all nodes, of the lamps in slots, and of the slots of lamps.
std::uint64_t lamp_tree_words(std::uint32_t lamp_count, bool motion);

// A lamp as the tree has it.
struct TreeLamp {
    SeenSphere sphere;
    double radiance;    // mean of R, G, B
    std::uint32_t lamp; // its index in the kernel
};

// Fills the words, of which there are as many as lamp_tree_words says. lamps: in the order of the tree.
void write_lamp_tree(std::span<glm::vec4> words, std::span<const TreeLamp> lamps, bool motion);

} // namespace pt
