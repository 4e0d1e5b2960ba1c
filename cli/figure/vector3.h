// Vectors of the world, in double.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace cli {

using Vector3 = std::array<double, 3>;

constexpr double dot(const Vector3 &a, const Vector3 &b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

constexpr Vector3 cross(const Vector3 &a, const Vector3 &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// a + factor * b
constexpr Vector3 moved(const Vector3 &a, double factor, const Vector3 &b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

inline double length(const Vector3 &a) {
    return std::hypot(a[0], a[1], a[2]);
}

// a: not 0.
inline Vector3 normalized(const Vector3 &a) {
    const double size = length(a);
    return {a[0] / size, a[1] / size, a[2] / size};
}

} // namespace cli
