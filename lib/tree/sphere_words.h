#pragma once

#include "lib/scene/scene.h"
#include "lib/tree/grid.h"

#include <glm/glm.hpp>

#include <array>
#include <bit>
#include <cstdint>

namespace pt {

struct SphereWords {
    glm::uvec4 place; // center on the grid, then the radius as a float32
    glm::uvec4 way{0};

    SphereWords(const glm::uvec4 &place_of, const glm::uvec4 &way_of) : place(place_of), way(way_of) {}
    SphereWords(const Sphere &sphere, const Grid &grid);

    std::array<std::uint32_t, 8> all() const { return std::bit_cast<std::array<std::uint32_t, 8>>(*this); }

    MovingBall surface(const Grid &grid) const;

    // In steps of 1 / TREE_OPACITY_STEPS. Only for trees with opacities.
    std::int16_t opacity() const { return static_cast<std::int16_t>(place.w & gpu::TREE_OPACITY_STEPS); }

    GridBox box(const Grid &grid) const;

    // In grid steps.
    std::array<float, 4> ball(const Grid &grid) const;

private:
    glm::ivec3 center() const { return glm::ivec3(place); }
    double radius() const { return std::bit_cast<float>(place.w); }
};

} // namespace pt
