// The tree that the kernel descends to choose one of many lamps: its shape, and which lamps are neighbours in it.
// gpu_layout.h describes its nodes, lib/kernel/lamp_tree_words.h writes them.
#pragma once

#include "lib/scene/scene.h"

#include <cstdint>
#include <vector>

namespace pt {

// The shape depends on the number of lamps alone, so moving the camera or the lamps needs no other kernel. At the top
// there are one to four groups of four nodes, and below each node another group of four. The nodes of the last level
// are slots for lamps; with more than 16 lamps, more than half of the slots are taken.
class LampTreeShape {
public:
    explicit LampTreeShape(std::uint32_t lamp_count);

    std::uint32_t levels() const { return levels_; } // below the top; at least 1
    std::uint32_t top_groups() const { return top_groups_; }
    std::uint64_t slots() const { return 4 * groups_of(levels_); }

    // Groups of a level; the top is level 0.
    std::uint64_t groups_of(std::uint32_t level) const { return std::uint64_t{top_groups_} << (2 * level); }
    // Groups above a level.
    std::uint64_t groups_above(std::uint32_t level) const {
        return top_groups_ * (((std::uint64_t{1} << (2 * level)) - 1) / 3);
    }
    std::uint64_t all_groups() const { return groups_above(levels_ + 1); }

    // The index, in the order of the tree, of the first lamp that is not before this slot.
    std::uint32_t first_lamp(std::uint64_t slot) const {
        return static_cast<std::uint32_t>((slot * lamp_count_ + slots() - 1) / slots());
    }

private:
    std::uint32_t lamp_count_;
    std::uint32_t levels_ = 1;
    std::uint32_t top_groups_;
};

// Indices of the spheres that emit, in the order of their slots, for the middle of the time interval [0, 1]. Emitting
// spheres that are no lamps, as the camera sees them, are left out, and the others keep their order.
std::vector<std::uint32_t> order_in_lamp_tree(const Scene &scene);

} // namespace pt
