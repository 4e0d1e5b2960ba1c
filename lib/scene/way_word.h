// Where a sphere goes, as kernels read it (shaders/gpu_layout.h).
#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace pt {

// The way; for a capsule also 1 / its length. Where that overflows, the way is far shorter than any radius (at least
// 1e-18), and the capsule is held as a ball.
inline glm::vec4 way_word(const glm::dvec3 &way, bool swept) {
    const glm::vec3 rounded = glm::vec3(way) + 0.0F; // -0 is made +0, for twins
    if (!swept)
        return {rounded, 0.0F};
    const auto inverse = static_cast<float>(1.0 / glm::length(way));
    return std::isfinite(inverse) ? glm::vec4(rounded, inverse) : glm::vec4(0.0F);
}

} // namespace pt
