// The tree of lamps in the words of the scene buffer (shaders/gpu_layout.h).
#pragma once

#include "lib/scene/seen_scene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace pt {

// From this many lamps on, the kernel chooses among them by a tree. Measured on lavapipe, without the rays: with 24
// lamps a tree is as fast as looking at all of them, with 32 a third faster.
constexpr std::uint32_t least_tree_lamps = 32;

// Words for all nodes, for the lamps in slots, and for the slots of lamps.
std::uint64_t lamp_tree_words(std::uint32_t lamp_count, bool motion);

// A lamp as the tree holds it.
struct TreeLamp {
    SeenSphere sphere;
    double radiance;    // mean of R, G, B
    std::uint32_t lamp; // its index in the kernel
};

// Fills the words; there are as many as lamp_tree_words says. lamps: in the tree's order.
void write_lamp_tree(std::span<glm::vec4> words, std::span<const TreeLamp> lamps, bool motion);

} // namespace pt
