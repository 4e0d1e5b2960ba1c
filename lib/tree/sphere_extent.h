#pragma once

#include "lib/scene/scene.h"
#include "lib/tree/grid.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace pt {

struct SphereExtent {
    PointBox box{glm::dvec3(std::numeric_limits<double>::infinity()),
                 glm::dvec3(-std::numeric_limits<double>::infinity())};
    double largest_radius = 0.0;
    bool moves = false;
    Kinds kinds{};
    std::uint32_t lamp_count = 0;

    void add(const Sphere &sphere, bool emits) {
        add({box_about(sphere.ball()), sphere.radius, sphere.ball().moves(), {}, emits ? 1U : 0U});
        kinds.add(sphere.kind);
    }

    void add(const SphereExtent &other) {
        box = {glm::min(box.low, other.box.low), glm::max(box.high, other.box.high)};
        largest_radius = std::max(largest_radius, other.largest_radius);
        moves = moves || other.moves;
        kinds.add(other.kinds);
        lamp_count += other.lamp_count;
    }

    // Extends the grid by a step, because places are rounded.
    Grid grid() const {
        const glm::dvec3 half = 0.5 * box.high - 0.5 * box.low;
        return {0.5 * box.low + 0.5 * box.high, std::max({half.x, half.y, half.z, largest_radius}) * (1.0 + 0x1p-28)};
    }
};

} // namespace pt
