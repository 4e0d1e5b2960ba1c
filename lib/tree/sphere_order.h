// The shape of a tree: which spheres and nodes are each node's children.
#pragma once

#include "lib/base/work_progress.h"
#include "shaders/gpu_layout.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pt {

// Approximate center and radius, in any unit. A moving sphere counts as a ball around its way.
struct TreeItem {
    std::array<float, 4> centre_radius;
    std::uint32_t sphere;
};

inline constexpr std::uint32_t tree_width = gpu::TREE_WIDTH; // most children of a node

// Child nodes come first and are consecutive; so are places of child spheres.
struct TreeLinks {
    std::uint32_t first_child;
    std::uint32_t first_place;
    std::uint8_t inner_count;
    std::uint8_t child_count;
};

struct TreeShape {
    std::vector<TreeLinks> nodes;       // the root first, each before its children
    std::vector<std::uint32_t> spheres; // index by slot
    std::uint32_t depth;                // nodes on the longest way down, with the root
};

// Everything that tells spheres apart: place and, if rays may pass them, look. Spheres with equal bits are twins and
// must have equal items; the one with the lowest number is kept.
using SphereBits = std::array<std::uint32_t, 10>;
using BitsOfSphere = std::function<SphereBits(std::uint32_t)>;

// Divides nodes where surface times expected nodes, summed over both sides, is least (Goldsmith and Salmon 1987; in
// bins: Wald 2007). Deep nodes are halved, which bounds the depth: 27 for 2^26 spheres. An item is a unit of work.
TreeShape tree_shape(std::vector<TreeItem> items, const BitsOfSphere &bits_of, WorkProgress &progress);

} // namespace pt
