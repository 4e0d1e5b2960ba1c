#include "lib/tree/tree_node.h"

#include <bit>

namespace pt {

namespace {

constexpr std::uint32_t most_steps = 255;

// Returns the exponent of the smallest step with which a byte covers the extent.
std::uint32_t exponent_for(std::uint32_t extent) {
    const auto bits = static_cast<std::uint32_t>(std::bit_width(extent));
    std::uint32_t exponent = bits > 8 ? bits - 8 : 0;
    while ((extent + (1U << exponent) - 1) >> exponent > most_steps)
        ++exponent;
    return exponent;
}

std::uint32_t head_of(const TreeLinks &links) {
    return std::uint32_t{links.child_count} << 16 | std::uint32_t{links.inner_count} << 20;
}

} // namespace

TreeNodeWords words_of(const TreeLinks &links) {
    return {glm::uvec4(0, 0, 0, head_of(links)), glm::uvec4(links.first_child, links.first_place, 0, 0), glm::uvec4(0)};
}

TreeNodeWords TreeNode::words() const {
    std::uint32_t head = head_of(links_);
    std::array<std::uint32_t, 6> sides{};
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t exponent = exponent_for(static_cast<std::uint32_t>(box_.high[axis] - box_.low[axis]));
        head |= exponent << (5 * axis);
        for (std::uint32_t child = 0; child < links_.child_count; ++child) {
            const auto low = static_cast<std::uint32_t>(boxes_[child].low[axis] - box_.low[axis]);
            const auto high = static_cast<std::uint32_t>(boxes_[child].high[axis] - box_.low[axis]);
            const auto i = static_cast<std::size_t>(axis);
            sides[i] |= low >> exponent << (8 * child);
            sides[i + 3] |= (high + (1U << exponent) - 1) >> exponent << (8 * child);
        }
    }
    return {glm::uvec4(std::bit_cast<std::uint32_t>(box_.low.x), std::bit_cast<std::uint32_t>(box_.low.y),
                       std::bit_cast<std::uint32_t>(box_.low.z), head),
            glm::uvec4(links_.first_child, links_.first_place, sides[0], sides[1]),
            glm::uvec4(sides[2], sides[3], sides[4], sides[5])};
}

GridBox TreeNodeView::box(std::uint32_t child) const {
    const std::array sides = {words_[1].z, words_[1].w, words_[2].x, words_[2].y, words_[2].z, words_[2].w};
    const std::array corner = {words_[0].x, words_[0].y, words_[0].z};
    GridBox box;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const std::uint32_t exponent = words_[0].w >> (5 * axis) & 31;
        const auto side = [&](std::uint32_t word) {
            return std::bit_cast<int>(corner[i] + ((word >> (8 * child) & most_steps) << exponent));
        };
        box.low[axis] = side(sides[i]);
        box.high[axis] = side(sides[i + 3]);
    }
    return box;
}

} // namespace pt
