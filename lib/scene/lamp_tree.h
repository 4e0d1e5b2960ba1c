// The tree of a scene's lamps that the kernel descends to choose one of many: its shape, and which lamps are near to
// each other in it. gpu_layout.h describes its nodes, lib/kernel/lamp_tree_words.h writes them.
#pragma once

#include "lib/scene/scene.h"

#include <cstdint>
#include <vector>

namespace pt {

// Depends on the number of lamps alone, so that a camera that moves and lamps that do need no other kernel. On top
// there are one to four groups of four nodes, below each node a group of four; the nodes of the last level are slots
// for lamps, of which in a tree of more than 16 lamps more than half are taken.
class LampTreeShape {
public:
    explicit LampTreeShape(std::uint32_t lamp_count);

    std::uint32_t levels() const { return levels_; } // below the top; at least 1
    std::uint32_t top_groups() const { return top_groups_; }
    std::uint64_t slots() const { return 4 * groups_of(levels_); }

    // Of a level, of which the top is number 0.
    std::uint64_t groups_of(std::uint32_t level) const { return std::uint64_t{top_groups_} << (2 * level); }
    // Above a level.
    std::uint64_t groups_above(std::uint32_t level) const;
    std::uint64_t all_groups() const { return groups_above(levels_ + 1); }

    // Of the lamps in their order, the first that is not before a slot.
    std::uint32_t first_lamp(std::uint64_t slot) const;

private:
    std::uint32_t lamp_count_;
    std::uint32_t levels_ = 1;
    std::uint32_t top_groups_;
};

// Indices of the spheres that emit, in the order in which they go into the slots, in the middle of their motion's unit
// of time. Of a scene some of whose spheres are no lamps, as the camera sees them, the others keep their order.
std::vector<std::uint32_t> order_in_lamp_tree(const Scene &scene);

} // namespace pt
