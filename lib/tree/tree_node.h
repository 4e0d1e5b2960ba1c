#pragma once

#include "lib/tree/grid.h"
#include "lib/tree/sphere_order.h"

#include <array>
#include <cstdint>
#include <span>

namespace pt {

using TreeNodeWords = std::array<glm::uvec4, gpu::TREE_NODE_WORDS>;

TreeNodeWords words_of(const TreeLinks &links);

class TreeNode {
public:
    explicit TreeNode(const TreeLinks &links) : links_(links) {}

    void set_box(std::uint32_t child, const GridBox &box) {
        boxes_[child] = box;
        box_.add(box);
    }

    const GridBox &box() const { return box_; }

    TreeNodeWords words() const;

private:
    TreeLinks links_;
    GridBox box_;
    std::array<GridBox, tree_width> boxes_{};
};

class TreeNodeView {
public:
    explicit TreeNodeView(std::span<const glm::uvec4> words) : words_(words.first(gpu::TREE_NODE_WORDS)) {}

    TreeLinks links() const {
        return {first_child(), first_place(), static_cast<std::uint8_t>(inner_count()),
                static_cast<std::uint8_t>(child_count())};
    }

    std::uint32_t child_count() const { return words_[0].w >> 16 & 7; }
    std::uint32_t inner_count() const { return words_[0].w >> 20 & 7; }
    std::uint32_t first_child() const { return words_[1].x; }
    std::uint32_t first_place() const { return words_[1].y; }

    GridBox box(std::uint32_t child) const;

private:
    std::span<const glm::uvec4> words_;
};

} // namespace pt
