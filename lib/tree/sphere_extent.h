#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/sphere_source.h"
#include "lib/tree/grid.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

namespace pt {

struct TreeMaterial {
    std::uint32_t index;
    bool emits;
};

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
    PointBox box{glm::dvec3(std::numeric_limits<double>::infinity()),
                 glm::dvec3(-std::numeric_limits<double>::infinity())};
    double largest_radius = 0.0;
    bool moves = false; // also true if only a sphere of left_out moves, because kernels read all motions or none
    Kinds kinds;
    std::uint32_t lamp_count = 0;

    SphereExtent(const SphereSource &spheres, std::span<const std::uint32_t> left_out,
                 std::span<const TreeMaterial> materials, WorkProgress &progress) {
        constexpr double share_of_extent = 0.06;
        progress.enter(share_of_extent, static_cast<double>(spheres.size()));
        for_each_in_tree(spheres, left_out, progress, [&](std::uint32_t, const Sphere &sphere) {
            const PointBox own = box_about(sphere.ball());
            box = {glm::min(box.low, own.low), glm::max(box.high, own.high)};
            largest_radius = std::max(largest_radius, sphere.radius);
            moves = moves || sphere.ball().moves();
            kinds.add(sphere.kind);
            lamp_count += materials[sphere.material].emits ? 1 : 0;
        });
        for (const std::uint32_t index : left_out)
            moves = moves || spheres[index].ball().moves();
    }

    // Extends the grid by a step, because places are rounded.
    Grid grid() const {
        const glm::dvec3 half = 0.5 * box.high - 0.5 * box.low;
        return {0.5 * box.low + 0.5 * box.high, std::max({half.x, half.y, half.z, largest_radius}) * (1.0 + 0x1p-28)};
    }
};

} // namespace pt
