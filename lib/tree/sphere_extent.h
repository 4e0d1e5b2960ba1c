// Which spheres are in a tree, the space that they take up over time, and how many of them emit. Used by SphereTree.
#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/sphere_source.h"
#include "lib/tree/grid.h"

#include <cstdint>
#include <limits>
#include <span>

namespace pt {

// What the tree needs to know about a material.
struct TreeMaterial {
    std::uint32_t index; // in the table of those in use
    bool emits;
};

// Calls use(index, sphere) for all spheres but those left out, by their indices in ascending order. Each is a unit of
// work.
template <typename Use>
void for_each_in_tree(const SphereSource &spheres, std::span<const std::uint32_t> left_out, WorkProgress &progress,
                      Use use) {
    spheres.for_each(progress, [&](std::size_t index, const Sphere &sphere, const glm::vec3 &) {
        if (!left_out.empty() && left_out.front() == index)
            left_out = left_out.subspan(1);
        else
            use(static_cast<std::uint32_t>(index), sphere);
    });
}

struct SphereExtent {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    double largest_radius = 0.0;
    bool moves = false;        // some sphere does, in the tree or left out: a kernel reads the ways of all or of none
    bool has_capsules = false; // some sphere of the tree is one
    std::uint32_t lamp_count = 0;

    // materials: all materials of the scene.
    SphereExtent(const SphereSource &spheres, std::span<const std::uint32_t> left_out,
                 std::span<const TreeMaterial> materials, WorkProgress &progress);

    // A grid that reaches all of them.
    Grid grid() const;
};

} // namespace pt
