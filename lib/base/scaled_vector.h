// Vectors scaled so that their squared lengths stay within double's range.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace pt {

inline glm::dvec3 vector(const double (&components)[3]) {
    return {components[0], components[1], components[2]};
}

// v = vector * 2^exponent, with the largest component of vector in [1/2, 1). Only components below 2^-1000 of the
// largest one are rounded.
struct ScaledVector {
    glm::dvec3 vector;
    int exponent;
};

inline ScaledVector scaled(const glm::dvec3 &v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    int exponent = 0;
    std::frexp(largest, &exponent);
    return {{std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), std::ldexp(v.z, -exponent)}, exponent};
}

// Returns v / |v| for finite v != 0. A product with 1 / |v| would round twice, and axes would not be exact.
inline glm::dvec3 unit_vector(const glm::dvec3 &v) {
    const glm::dvec3 vector = scaled(v).vector;
    return vector / glm::length(vector);
}

} // namespace pt
