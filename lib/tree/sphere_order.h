// The shape of a tree: the spheres and nodes that are each node's children. Made by SphereTree.
#pragma once

#include "lib/base/work_progress.h"
#include "shaders/gpu_layout.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pt {

// The input of the shape: approximate center and radius, in any unit. A moving sphere counts as a ball around its way.
struct TreeItem {
    std::array<float, 4> centre_radius;
    std::uint32_t sphere;
};

inline constexpr std::uint32_t tree_width = gpu::TREE_WIDTH; // of a node, at most

// Child nodes come first, and are consecutive; child spheres have consecutive places.
struct TreeLinks {
    std::uint32_t first_child;
    std::uint32_t first_place;
    std::uint8_t inner_count;
    std::uint8_t child_count;
};

struct TreeShape {
    std::vector<TreeLinks> nodes;       // the root first, each before its children
    std::vector<std::uint32_t> spheres; // by place
    std::uint32_t depth;                // nodes on the longest way down, root included
};

// All that tells spheres apart: where a sphere is and, if rays may pass it, its look. Spheres with equal bits are twins
// and have equal items; the one with the lowest number is kept.
using SphereBits = std::array<std::uint32_t, 10>;
using BitsOfSphere = std::function<SphereBits(std::uint32_t)>;

// Nodes are divided where surface times expected nodes, summed over both sides, is least (Goldsmith and Salmon 1987; in
// bins: Wald 2007). Deep in the tree they are halved, which bounds its depth for any spheres: for 2^26 of them it
// is 27. The work is one unit for each item.
TreeShape tree_shape(std::vector<TreeItem> items, const BitsOfSphere &bits_of, WorkProgress &progress);

} // namespace pt
