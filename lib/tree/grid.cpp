// Places of points; see grid.h.
#include "lib/tree/grid.h"

#include <algorithm>
#include <cmath>

namespace pt {

namespace {

// The smallest power of two of which 'reach' times is a distance or more; float32 must hold it and its inverse.
double step_for(double distance) {
    int exponent = 0; // distance / reach = fraction * 2^exponent with fraction in [1/2, 1)
    std::frexp(distance / Grid::reach, &exponent);
    return std::ldexp(1.0, std::clamp(exponent, -120, 120));
}

} // namespace

Grid::Grid(const glm::dvec3 &middle_of, double distance) : middle(middle_of), step(step_for(distance)) {}

glm::ivec3 Grid::place(const glm::dvec3 &point) const {
    const glm::dvec3 steps = (point - middle) / step;
    return {static_cast<int>(std::nearbyint(steps.x)), static_cast<int>(std::nearbyint(steps.y)),
            static_cast<int>(std::nearbyint(steps.z))};
}

} // namespace pt
