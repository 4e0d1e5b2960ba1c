// The integer grid of a tree's spheres. Differences of grid points are exact, so the tree does not depend on the
// camera.
#pragma once

#include "shaders/gpu_layout.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace pt {

struct Grid {
    // Largest absolute coordinate. Differences to a camera at twice this distance do not overflow.
    static constexpr double reach = gpu::TREE_REACH;

    glm::dvec3 middle;
    double step; // scene units, a power of two
    double steps_per_unit;

    // Makes the finest grid that reaches this distance along each axis.
    Grid(const glm::dvec3 &middle_of, double distance) :
        middle(middle_of),
        step(step_for(distance)),
        steps_per_unit(1.0 / step) {}

    glm::ivec3 place(const glm::dvec3 &point) const {
        const glm::dvec3 steps = (point - middle) * steps_per_unit;
        return {nearest(steps.x), nearest(steps.y), nearest(steps.z)};
    }

    glm::dvec3 point(const glm::ivec3 &at) const { return middle + step * glm::dvec3(at); }

private:
    // Returns the smallest power of two for which `reach` steps cover the distance. float32 must hold the step and its
    // inverse.
    static double step_for(double distance) {
        int exponent = 0;
        std::frexp(distance / reach, &exponent);
        return std::ldexp(1.0, std::clamp(exponent, -120, 120));
    }

    // Doubles near 1.5 * 2^52 have a spacing of 1, so the sum is rounded to an integer, ties to even.
    static int nearest(double number) {
        constexpr double ones_are_last = 0x1.8p52;
        return static_cast<int>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(number + ones_are_last)));
    }
};

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

    double surface() const {
        const glm::dvec3 sides = glm::dvec3(high) - glm::dvec3(low);
        return sides.x * sides.y + sides.y * sides.z + sides.z * sides.x;
    }
};

inline bool meet(const GridBox &a, const GridBox &b) {
    return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
}

} // namespace pt
