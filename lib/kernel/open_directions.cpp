// Counts the directions of a lattice on the sphere; see open_directions.h.
#include "lib/kernel/open_directions.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace pt {

namespace {

constexpr std::size_t direction_count = 512; // tell a share to within 0.03

// Heights in equal steps, each turned from the one before by the golden section of a turn, which leaves no gaps
// (Swinbank and Purser, "Fibonacci grids", 2006).
std::array<glm::dvec3, direction_count> spread_directions() {
    std::array<glm::dvec3, direction_count> directions{};
    for (std::size_t i = 0; i < direction_count; ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / direction_count;
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / std::numbers::phi;
        const double across = std::sqrt(1.0 - z * z);
        directions[i] = {across * std::cos(angle), across * std::sin(angle), z};
    }
    return directions;
}

} // namespace

double open_directions(std::span<const CurvedPlane> planes) {
    static const std::array directions = spread_directions();
    const auto is_open = [&](const glm::dvec3 &direction) {
        return std::ranges::all_of(planes, [&](const CurvedPlane &plane) {
            return glm::dot(plane.normal, direction) * (plane.offset < 0.0 ? -1.0 : 1.0) > 0.0;
        });
    };
    return static_cast<double>(std::ranges::count_if(directions, is_open)) / direction_count;
}

} // namespace pt
