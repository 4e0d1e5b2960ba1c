// Finds what reaches farthest; see outlying.h.
#include "lib/tree/outlying.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

namespace pt {

namespace {

constexpr std::size_t most_outlying = 16; // each costs every ray a test

constexpr double much_farther = 16.0; // so that a grid loses four bits at the most

// Medians of the coordinates of a thousand spheres or so.
glm::dvec3 middle_of(std::span<const Sphere> spheres) {
    constexpr std::size_t enough = 1000;
    const std::size_t step = spheres.size() / enough + 1;
    glm::dvec3 middle;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> coordinates;
        for (std::size_t i = 0; i < spheres.size(); i += step)
            coordinates.push_back(spheres[i].center[axis]);
        const auto half = coordinates.begin() + static_cast<std::ptrdiff_t>(coordinates.size() / 2);
        std::ranges::nth_element(coordinates, half);
        middle[axis] = *half;
    }
    return middle;
}

double reach_of(const Sphere &sphere, const glm::dvec3 &middle) {
    return glm::length(sphere.center - middle) + glm::length(sphere.motion) + sphere.radius;
}

} // namespace

std::vector<std::uint32_t> outlying_spheres(std::span<const Sphere> spheres) {
    const std::size_t few = std::min(most_outlying, spheres.size() / 2);
    const glm::dvec3 middle = middle_of(spheres);

    // The farthest ones and one more, farthest first.
    using Reach = std::pair<double, std::uint32_t>;
    std::vector<Reach> farthest;
    for (std::uint32_t i = 0; i < spheres.size(); ++i) {
        const Reach reach(reach_of(spheres[i], middle), i);
        if (farthest.size() > few && reach.first <= farthest.back().first)
            continue;
        farthest.insert(std::ranges::upper_bound(farthest, reach, std::greater()), reach);
        farthest.resize(std::min(farthest.size(), few + 1));
    }

    std::vector<std::uint32_t> outlying;
    for (const auto &[reach, index] : farthest)
        if (reach > much_farther * farthest.back().first)
            outlying.push_back(index);
    std::ranges::sort(outlying);
    return outlying;
}

} // namespace pt
