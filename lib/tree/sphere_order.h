// The shape of a tree over spheres: which spheres and which nodes are children of which node. Made by SphereTree.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pt {

// What the shape is made from: about where a sphere is and how large, in any unit. One that moves is taken for a ball
// about its way.
struct TreeItem {
    std::array<float, 4> centre_radius;
    std::uint32_t sphere;
};

inline constexpr std::uint32_t tree_width = 4; // children of a node, at most

// Inner children come first; they are consecutive nodes, and the spheres consecutive places.
struct TreeLinks {
    std::uint32_t first_child;
    std::uint32_t first_place;
    std::uint8_t inner_count;
    std::uint8_t child_count;
};

struct TreeShape {
    std::vector<TreeLinks> nodes;       // the root first, and each before its children
    std::vector<std::uint32_t> spheres; // the sphere of each place
    std::uint32_t depth;                // nodes from the root to the deepest, both counted
};

// What else the shape depends on.
struct TreeRules {
    // Some order of two spheres. Those that are equal in it have equal items: of such twins the one with the lower number is
    // kept.
    std::function<std::strong_ordering(std::uint32_t, std::uint32_t)> order;
    // Called now and then with the share of the spheres that have their places. What it throws ends the work.
    std::function<void(double)> progress;
};

// Nodes are divided where that makes the product of surface and nodes to come least, summed over both sides (Goldsmith
// and Salmon 1987; in bins: Wald 2007). Deep in the tree they are halved, so that its depth is bounded, whatever the
// spheres: for 2^26 of them it is 27.
TreeShape tree_shape(std::vector<TreeItem> items, const TreeRules &rules);

} // namespace pt
