// Directions in long double as the papers define them, and bounds on what float32 makes of them.
#pragma once

#include "tests/device/accuracy/comparison.h"
#include "tests/device/accuracy/inputs.h"

#include <cmath>
#include <numbers>

namespace accuracy {

constexpr Real pi = std::numbers::pi_v<Real>;

inline Direction direction_at(Real cosine, Real sine, Real turns) {
    return {sine * std::cos(2 * pi * turns), sine * std::sin(2 * pi * turns), cosine};
}

// A vector about z turned to be about an axis by the basis of Duff et al. (JCGT 6(1), 2017). Where axis.z >= 0 that is
// Frisvad's: the smallest rotation that takes z to the axis, k = z x axis, v + k x v + k x (k x v) / (1 + cos). Where
// axis.z < 0 it is Frisvad's about -axis, with its second and third vector turned round.
inline Direction turned_to(const glm::vec3 &float_axis, const Direction &vector) {
    const bool down = float_axis.z < 0.0F;
    const Direction axis = glm::normalize(Direction(float_axis)) * (down ? Real{-1} : Real{1});
    const Direction v = down ? Direction(vector.x, -vector.y, -vector.z) : vector;
    const Direction k(-axis.y, axis.x, 0);
    const Direction k_v = glm::cross(k, v);
    return v + k_v + glm::cross(k, k_v) / (1 + axis.z);
}

// Bounds on the length of an error vector, with u = 2^-24 (half_ulp). Absolute: a unit vector's components pass
// through 0, and what matters is the angle. Vulkan's division is within 2.5 ulp <= 5 u; sqrt is 1 / inversesqrt, 4 u
// and 5 u. For narrow cones the parts with the factor sine vanish.

// sin_cos_turn: 4.5 ulp of at most u each (lib/kernel/accuracy.cpp), and a product each.
inline Real azimuth_bound(Real sine) {
    return sine * (4.5L * std::sqrt(Real{2}) + 1) * half_ulp;
}

// rotate_to_axis. q, at most sine as |x v.x| + |y v.y| is, errs by 2 u of that; its quotient by 6 u more, 8 u sine;
// along, of at most sqrt(2), by u for its sum. x and y of the result err by that, by sqrt(2) u for the product and 0.7
// u for the sums, z by u for its product, 2 u sine for q and u / 2 for the sum: 8.3 u sine and 3.5 u in all. The sum is
// that of the basis: its tangents err by 2.5 times what the axis lacks of unit length; two of them, |v.x| + |v.y| <=
// sqrt(2) sine.
inline Real rotation_bound(const glm::vec3 &axis, Real sine) {
    const Real length = length_error(axis);
    return sine * (8.3L * half_ulp + 2.5L * std::sqrt(Real{2}) * length) + length + 3.5L * half_ulp;
}

// direction_about, where one_minus_cos errs by the given share of itself. The polar angle errs by share * h / sine;
// sine = sqrt(h (2 - h)) by a half of 2 u and by the 9 u of sqrt, 1 - h by u / 2.
inline Real direction_about_bound(const glm::vec3 &axis, Real h, Real share) {
    const Real sine = std::sqrt(h * (2 - h));
    const Real polar = sine > 0 ? share * h / sine : 0;
    return rotation_bound(axis, sine) + azimuth_bound(sine) + 10 * half_ulp * sine + polar + half_ulp / 2;
}

} // namespace accuracy
