#pragma once

#include "lib/view/lamp.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace pt {

// From this many lamps on, a tree is faster than a loop.
constexpr std::uint32_t least_tree_lamps = 32;

std::uint64_t lamp_tree_words(std::uint32_t lamp_count, bool motion);

// `words` must have the size lamp_tree_words(). `lamps` must be in the tree's order.
void write_lamp_tree(std::span<glm::vec4> words, std::span<const Lamp> lamps, bool motion);

} // namespace pt
