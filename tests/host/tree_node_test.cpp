// Nodes of a tree in bytes: children's boxes are rounded outwards, by less than one of the node's steps.
#include "lib/tree/tree_node.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <random>

namespace {

// What a byte has to count in: the smallest power of two of which 255 span an extent.
std::int64_t step_of(std::int64_t extent) {
    std::int64_t step = 1;
    while (255 * step < extent)
        step *= 2;
    return step;
}

void expect_rounded_outwards(const std::array<pt::GridBox, pt::tree_width> &boxes, std::uint32_t count) {
    pt::TreeNode node({7, 9, static_cast<std::uint8_t>(count / 2), static_cast<std::uint8_t>(count)});
    pt::GridBox all;
    for (std::uint32_t child = 0; child < count; ++child) {
        node.set_box(child, boxes[child]);
        all.add(boxes[child]);
    }
    EXPECT_EQ(node.box(), all);
    const auto words = node.words();
    const pt::TreeNodeView view(words);
    EXPECT_EQ(view.child_count(), count);
    EXPECT_EQ(view.inner_count(), count / 2);
    EXPECT_EQ(view.first_child(), 7U);
    EXPECT_EQ(view.first_place(), 9U);
    for (std::uint32_t child = 0; child < count; ++child) {
        const pt::GridBox rounded = view.box(child);
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t step = step_of(std::int64_t{all.high[axis]} - all.low[axis]);
            const std::int64_t below = std::int64_t{boxes[child].low[axis]} - rounded.low[axis];
            const std::int64_t above = std::int64_t{rounded.high[axis]} - boxes[child].high[axis];
            EXPECT_TRUE(below >= 0 && below < step) << "axis " << axis << ": " << below << " of " << step;
            EXPECT_TRUE(above >= 0 && above < step) << "axis " << axis << ": " << above << " of " << step;
        }
    }
}

TEST(TreeNode, RoundsBoxesOutwardsByLessThanAStep) {
    std::mt19937 engine(5);
    const std::int64_t extents[] = {0, 1, 2, 254, 255, 256, 257, 510, 511, 65535, 1 << 29, 1 << 30};
    const auto at_most = [&](std::int64_t most) {
        return static_cast<int>(std::uniform_int_distribution<std::int64_t>(0, most)(engine));
    };
    for (const std::int64_t extent : extents)
        for (std::uint32_t count = 1; count <= pt::tree_width; ++count)
            for (int trial = 0; trial < 50; ++trial) {
                const glm::ivec3 corner = glm::ivec3(-(1 << 29)) + (trial % 2 == 0 ? 0 : at_most((1 << 30) - extent));
                std::array<pt::GridBox, pt::tree_width> boxes;
                for (pt::GridBox &box : boxes)
                    for (int axis = 0; axis < 3; ++axis) {
                        const int low = at_most(extent);
                        box.low[axis] = corner[axis] + low;
                        box.high[axis] = box.low[axis] + at_most(extent - low);
                    }
                boxes[0].low = corner; // the whole extent is there
                boxes[count - 1].high = corner + static_cast<int>(extent);
                SCOPED_TRACE("extent " + std::to_string(extent) + ", children " + std::to_string(count));
                expect_rounded_outwards(boxes, count);
            }
}

} // namespace
