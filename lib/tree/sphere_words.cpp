#include "lib/tree/sphere_words.h"

namespace pt {

namespace {

// Rounds to the nearest float32 whose low bits are the opacity. A separate word would make walks slower.
std::uint32_t radius_bits(const Sphere &sphere) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(sphere.radius));
    if (sphere.opacity == no_opacity)
        return bits;
    const auto opacity = static_cast<std::uint32_t>(sphere.opacity);
    constexpr std::uint32_t half = (gpu::TREE_OPACITY_STEPS + 1) / 2;
    return ((bits + half - opacity) & ~gpu::TREE_OPACITY_STEPS) + opacity;
}

// std::ceil is a function call on older processors.
int ceiling(double number) {
    const auto whole = static_cast<int>(number);
    return whole + (whole < number ? 1 : 0);
}

} // namespace

SphereWords::SphereWords(const Sphere &sphere, const Grid &grid) :
    place(grid.place(sphere.center), radius_bits(sphere)),
    way(std::bit_cast<glm::uvec4>(way_word(sphere.ball()))) {}

MovingBall SphereWords::surface(const Grid &grid) const {
    return surface_of(grid.point(center()), radius(), std::bit_cast<glm::vec4>(way));
}

GridBox SphereWords::box(const Grid &grid) const {
    const int reach = ceiling(radius() * grid.steps_per_unit);
    GridBox box{center() - reach, center() + reach};
    if (way != glm::uvec4(0)) {
        const glm::dvec3 steps = glm::dvec3(std::bit_cast<glm::vec4>(way)) / grid.step;
        box.low += glm::ivec3(glm::floor(glm::min(steps, 0.0)));
        box.high += glm::ivec3(glm::ceil(glm::max(steps, 0.0)));
    }
    return box;
}

std::array<float, 4> SphereWords::ball(const Grid &grid) const {
    const glm::dvec3 half_way = 0.5 * glm::dvec3(std::bit_cast<glm::vec4>(way));
    const glm::vec3 middle(glm::dvec3(center()) + half_way * grid.steps_per_unit);
    const double reach = radius() + glm::length(half_way);
    return {middle.x, middle.y, middle.z, static_cast<float>(reach * grid.steps_per_unit)};
}

} // namespace pt
