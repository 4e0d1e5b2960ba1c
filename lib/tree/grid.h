// The integer grid on which a tree holds places. Differences of places are exact, so nothing has to be rebuilt when the
// camera moves.
#pragma once

#include "shaders/gpu_layout.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace pt {

struct Grid {
    // The largest coordinate of a box, in steps. The camera may be twice as far away, and differences still fit into 32
    // bits.
    static constexpr double reach = gpu::TREE_REACH;

    glm::dvec3 middle; // of the grid, in the scene's units
    double step;       // a power of two, in the scene's units
    double steps_per_unit;

    // The finest grid that reaches a distance from its middle, along each axis.
    Grid(const glm::dvec3 &middle_of, double distance);

    // The grid place nearest to a point, which the grid must reach.
    glm::ivec3 place(const glm::dvec3 &point) const;

    // Where a place is.
    glm::dvec3 point(const glm::ivec3 &at) const { return middle + step * glm::dvec3(at); }
};

// A box of places that includes both ends. A default box is empty.
struct GridBox {
    glm::ivec3 low{INT32_MAX};
    glm::ivec3 high{INT32_MIN};

    void add(const glm::ivec3 &at) {
        low = glm::min(low, at);
        high = glm::max(high, at);
    }

    void add(const GridBox &other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }

    bool operator==(const GridBox &) const = default;

    glm::vec3 extent() const { return glm::vec3(high) - glm::vec3(low); }

    // Half of its surface area.
    double surface() const {
        const glm::dvec3 sides = glm::dvec3(high) - glm::dvec3(low);
        return sides.x * sides.y + sides.y * sides.z + sides.z * sides.x;
    }
};

inline bool meet(const GridBox &a, const GridBox &b) {
    return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
}

} // namespace pt
