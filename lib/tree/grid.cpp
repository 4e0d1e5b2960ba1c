// Places of points; see grid.h.
#include "lib/tree/grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pt {

namespace {

// The smallest power of two that, times 'reach', is at least a distance; float32 must hold it and its inverse.
double step_for(double distance) {
    int exponent = 0; // distance / reach = fraction * 2^exponent with fraction in [1/2, 1)
    std::frexp(distance / Grid::reach, &exponent);
    return std::ldexp(1.0, std::clamp(exponent, -120, 120));
}

// The last bit of such a large number counts ones, so adding to it rounds to whole numbers, ties to even.
int nearest(double number) {
    constexpr double ones_are_last = 0x1.8p52;
    return static_cast<int>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(number + ones_are_last)));
}

} // namespace

Grid::Grid(const glm::dvec3 &middle_of, double distance) :
    middle(middle_of),
    step(step_for(distance)),
    steps_per_unit(1.0 / step) {}

glm::ivec3 Grid::place(const glm::dvec3 &point) const {
    const glm::dvec3 steps = (point - middle) * steps_per_unit;
    return {nearest(steps.x), nearest(steps.y), nearest(steps.z)};
}

} // namespace pt
