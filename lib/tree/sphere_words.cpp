// Rounds spheres to words; see sphere_words.h.
#include "lib/tree/sphere_words.h"

namespace pt {

namespace {

// The float next to a radius whose last bits are the opacity, so that reading it takes no time: a word of its own took
// walks on lavapipe a fifth longer.
std::uint32_t radius_bits(const Sphere &sphere) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(sphere.radius));
    if (sphere.opacity == no_opacity)
        return bits;
    const auto opacity = static_cast<std::uint32_t>(sphere.opacity);
    constexpr std::uint32_t half = (gpu::TREE_OPACITY_STEPS + 1) / 2;
    return ((bits + half - opacity) & ~gpu::TREE_OPACITY_STEPS) + opacity;
}

} // namespace

glm::uvec4 sphere_word(const Sphere &sphere, const Grid &grid) {
    return {grid.place(sphere.center), radius_bits(sphere)};
}

glm::uvec4 motion_word(const Sphere &sphere) {
    return std::bit_cast<glm::uvec4>(way_word(sphere.ball()));
}

std::uint32_t color_word(const glm::vec3 &color) {
    const glm::uvec3 steps(glm::sqrt(glm::clamp(color, 0.0F, 1.0F)) * float{gpu::TREE_COLOR_STEPS} + 0.5F);
    return steps.r | steps.g << 10 | steps.b << 20;
}

std::array<std::uint32_t, 8> words_of(const Sphere &sphere, const Grid &grid) {
    const glm::uvec4 place = sphere_word(sphere, grid);
    const glm::uvec4 motion = motion_word(sphere);
    return {place.x, place.y, place.z, place.w, motion.x, motion.y, motion.z, motion.w};
}

std::array<float, 4> ball_of(const Sphere &sphere, const Grid &grid) {
    const glm::uvec4 word = sphere_word(sphere, grid);
    const glm::dvec3 half_way = 0.5 * way_of(motion_word(sphere));
    const glm::vec3 centre(glm::dvec3(centre_of(word)) + half_way * grid.steps_per_unit);
    const double radius = radius_of(word) + glm::length(half_way);
    return {centre.x, centre.y, centre.z, static_cast<float>(radius * grid.steps_per_unit)};
}

} // namespace pt
