#pragma once

#include "lib/scene/scene.h"

#include <cstdint>
#include <vector>

namespace pt {

// The shape of the lamp tree (gpu_layout.h). It depends only on the number of lamps, so moving lamps needs no new
// kernel.
class LampTreeShape {
public:
    explicit LampTreeShape(std::uint32_t lamp_count);

    std::uint32_t levels() const { return levels_; }
    std::uint32_t top_groups() const { return top_groups_; }
    std::uint64_t slots() const { return 4 * groups_of(levels_); }

    std::uint64_t groups_of(std::uint32_t level) const { return std::uint64_t{top_groups_} << (2 * level); }
    std::uint64_t groups_above(std::uint32_t level) const {
        return top_groups_ * (((std::uint64_t{1} << (2 * level)) - 1) / 3);
    }
    std::uint64_t all_groups() const { return groups_above(levels_ + 1); }

    std::uint32_t first_lamp(std::uint64_t slot) const {
        return static_cast<std::uint32_t>((slot * lamp_count_ + slots() - 1) / slots());
    }

private:
    std::uint32_t lamp_count_;
    std::uint32_t levels_ = 1;
    std::uint32_t top_groups_;
};

// Returns emitting spheres in the order of slots, by their positions at time 1/2.
std::vector<std::uint32_t> order_in_lamp_tree(const Scene &scene);

} // namespace pt
