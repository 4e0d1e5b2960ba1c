// A sphere as the kernel reads it from a tree (gpu_layout.h): its words, and back.
#pragma once

#include "lib/scene/scene.h"
#include "lib/tree/grid.h"

#include <glm/glm.hpp>

#include <array>
#include <bit>
#include <cstdint>

namespace pt {

// Its place on the grid, and its radius.
glm::uvec4 sphere_word(const Sphere &sphere, const Grid &grid);

glm::uvec4 motion_word(const Sphere &sphere);

// Ten bits for the square root of each component, so that dark colors are kept apart as well as bright ones.
std::uint32_t color_word(const glm::vec3 &color);

// Everything that the kernel knows about where a sphere is.
std::array<std::uint32_t, 8> words_of(const Sphere &sphere, const Grid &grid);

// Centre and radius, in grid steps, of the ball around the sphere's way, as the kernel has it. Equal for twins.
std::array<float, 4> ball_of(const Sphere &sphere, const Grid &grid);

inline glm::ivec3 centre_of(const glm::uvec4 &sphere) {
    return {std::bit_cast<int>(sphere.x), std::bit_cast<int>(sphere.y), std::bit_cast<int>(sphere.z)};
}

inline double radius_of(const glm::uvec4 &sphere) {
    return std::bit_cast<float>(sphere.w);
}

inline bool is_swept(const glm::uvec4 &motion) {
    return motion.w != 0;
}

inline glm::dvec3 way_of(const glm::uvec4 &motion) {
    return {std::bit_cast<float>(motion.x), std::bit_cast<float>(motion.y), std::bit_cast<float>(motion.z)};
}

} // namespace pt
