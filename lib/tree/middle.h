#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pt {

// Returns the medians of about a thousand points, on which a few distant points have little effect.
template <typename CenterOf>
glm::dvec3 middle_of(std::uint32_t count, CenterOf center_of) {
    constexpr std::uint32_t enough = 1000;
    const std::uint32_t step = count / enough + 1;
    std::vector<glm::dvec3> centers;
    for (std::uint32_t i = 0; i < count; i += step)
        centers.push_back(center_of(i));
    glm::dvec3 middle;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> coordinates(centers.size());
        std::ranges::transform(centers, coordinates.begin(), [axis](const glm::dvec3 &center) { return center[axis]; });
        const auto half = coordinates.begin() + static_cast<std::ptrdiff_t>(coordinates.size() / 2);
        std::ranges::nth_element(coordinates, half);
        middle[axis] = *half;
    }
    return middle;
}

} // namespace pt
