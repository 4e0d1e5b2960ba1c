#pragma once

#include "lib/tree/sphere_tree.h"
#include "lib/tree/tree_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace heap_tree {

inline const std::vector<pt::TreeMaterial> two_materials = {{0, false}, {1, true}};

inline std::vector<pt_sphere> heap(std::size_t count, double motion) {
    std::mt19937 engine(17);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    std::vector<pt_sphere> spheres;
    for (std::size_t i = 0; i < count; ++i)
        spheres.push_back({{5 + share(engine), share(engine), share(engine) - 3},
                           0.01 * std::exp(2.0 * share(engine)),
                           {motion * share(engine), motion * share(engine), 0},
                           i % 10 == 3 ? 1U : 0U,
                           0});
    return spheres;
}

inline pt::TreeChoice choice_without(const std::vector<std::uint32_t> &left_out, const pt::SphereSource &spheres) {
    pt::TreeChoice choice{.left_out = left_out};
    for (std::uint32_t i = 0; i < spheres.size(); ++i)
        if (std::ranges::find(left_out, i) == left_out.end())
            choice.extent.add(spheres[i], two_materials[spheres[i].material].emits);
        else
            choice.extent.moves = choice.extent.moves || spheres[i].ball().moves();
    return choice;
}

inline pt::SphereTree tree_of(const pt::SphereSource &spheres, const std::vector<std::uint32_t> &left_out = {}) {
    pt::WorkProgress nobody;
    return {spheres, choice_without(left_out, spheres), two_materials, nobody};
}

inline pt::SphereTree tree_of(const std::vector<pt_sphere> &spheres) {
    return tree_of(pt::SphereSource(spheres, {}));
}

inline const pt::Camera camera{glm::dvec3(0.0), {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.0, 1.0};

struct Held {
    glm::ivec3 center;
    glm::dvec3 way; // in grid steps
    double radius;  // in grid steps
};

inline Held held(const pt::SphereTree &tree, std::uint32_t place) {
    const pt::gpu::TreeFrame frame = tree.frame(camera);
    const glm::uvec4 &word = tree.sphere_words()[place];
    const double step = tree.grid().step;
    Held sphere{glm::ivec3(word.x, word.y, word.z), glm::dvec3(0.0), double{std::bit_cast<float>(word.w)} / step};
    if (tree.moves()) {
        const glm::uvec4 &way = tree.sphere_words()[frame.first_motion + place];
        for (int axis = 0; axis < 3; ++axis)
            sphere.way[axis] = double{std::bit_cast<float>(way[axis])} / step;
    }
    return sphere;
}

inline void expect_holds(const pt::GridBox &box, const Held &sphere) {
    for (const double time : {0.0, 0.3, 1.0}) {
        const glm::dvec3 center = glm::dvec3(sphere.center) + time * sphere.way;
        EXPECT_TRUE(glm::all(glm::lessThanEqual(glm::dvec3(box.low), center - sphere.radius)));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(center + sphere.radius, glm::dvec3(box.high))));
    }
}

inline std::size_t expect_boxes_hold(const pt::SphereTree &tree, std::uint32_t node, std::vector<pt::GridBox> &boxes) {
    const std::span<const glm::uvec4> words(tree.words());
    const pt::TreeNodeView view(words.subspan(std::size_t{node} * pt::gpu::TREE_NODE_WORDS));
    std::size_t met = 0;
    for (std::uint32_t child = 0; child < view.child_count(); ++child) {
        boxes.push_back(view.box(child));
        if (child < view.inner_count()) {
            met += expect_boxes_hold(tree, view.first_child() + child, boxes);
        } else {
            const Held sphere = held(tree, view.first_place() + child - view.inner_count());
            for (const pt::GridBox &box : boxes)
                expect_holds(box, sphere);
            ++met;
        }
        boxes.pop_back();
    }
    return met;
}

inline void expect_all_held(const pt::SphereTree &tree, std::size_t count) {
    std::vector<pt::GridBox> boxes;
    EXPECT_EQ(expect_boxes_hold(tree, 0, boxes), count);
}

} // namespace heap_tree
