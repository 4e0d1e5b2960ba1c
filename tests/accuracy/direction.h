#pragma once

#include "tests/accuracy/comparison.h"
#include "tests/accuracy/inputs.h"

#include <cmath>
#include <numbers>

namespace accuracy {

constexpr Real pi = std::numbers::pi_v<Real>;

inline Direction direction_at(Real cosine, Real sine, Real turns) {
    return {sine * std::cos(2 * pi * turns), sine * std::sin(2 * pi * turns), cosine};
}

// Turns a vector from the z axis to the axis, in the basis of Duff et al. (JCGT 6(1), 2017). With k = z x axis the
// result is v + k x v + k x (k x v) / (1 + cos) for axis.z >= 0. For axis.z < 0 the basis is built for -axis, and its
// second and third vectors are negated.
inline Direction turned_to(const glm::vec3 &float_axis, const Direction &vector) {
    const bool down = float_axis.z < 0.0F;
    const Direction axis = glm::normalize(Direction(float_axis)) * (down ? Real{-1} : Real{1});
    const Direction v = down ? Direction(vector.x, -vector.y, -vector.z) : vector;
    const Direction k(-axis.y, axis.x, 0);
    const Direction k_v = glm::cross(k, v);
    return v + k_v + glm::cross(k, k_v) / (1 + axis.z);
}

// The bounds below are lengths of error vectors. Let u = 2^-24. A division adds an error of 5 u (2.5 ulp), and sqrt = 1
// / inversesqrt adds 4 u + 5 u.

// sin_cos_turn has an error of at most 4.5 u (lib/kernel/accuracy.cpp). Each product adds u.
inline Real azimuth_bound(Real sine) {
    return sine * (4.5L * std::sqrt(Real{2}) + 1) * half_ulp;
}

// Bounds the error of rotate_to_axis. q <= sine has an error of 2 u and its quotient an error of 6 u, in total 8 u
// sine. `along` <= sqrt(2) has an error of u. Both errors count in x and y, where the product adds sqrt(2) u and the
// sums add 0.7 u. In z the product adds u, q adds 2 u sine, and the sum adds u / 2. If the axis's length deviates from
// 1 by l, the tangents add 2.5 l (|v.x| + |v.y|) <= 2.5 l sqrt(2) sine.
inline Real rotation_bound(const glm::vec3 &axis, Real sine) {
    const Real length = length_error(axis);
    return sine * (8.3L * half_ulp + 2.5L * std::sqrt(Real{2}) * length) + length + 3.5L * half_ulp;
}

// `share` is the relative error of h = 1 - cos. This error turns the polar angle by share h / sine. The error of sine =
// sqrt(h (2 - h)) is u + 9 u, and 1 - h adds u / 2.
inline Real direction_about_bound(const glm::vec3 &axis, Real h, Real share) {
    const Real sine = std::sqrt(h * (2 - h));
    const Real polar = sine > 0 ? share * h / sine : 0;
    return rotation_bound(axis, sine) + azimuth_bound(sine) + 10 * half_ulp * sine + polar + half_ulp / 2;
}

} // namespace accuracy
