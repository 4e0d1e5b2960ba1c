// Arithmetic of what scenes of other programs have.
#pragma once

#include "cli/import/foreign_scene.h"

#include <cmath>

namespace cli {

inline double dot(const ForeignVector &a, const ForeignVector &b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline ForeignVector difference(const ForeignVector &a, const ForeignVector &b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// origin + distance * direction
inline ForeignVector point_at(const ForeignVector &origin, double distance, const ForeignVector &direction) {
    return {origin[0] + distance * direction[0], origin[1] + distance * direction[1],
            origin[2] + distance * direction[2]};
}

inline double length(const ForeignVector &vector) {
    return std::hypot(vector[0], vector[1], vector[2]);
}

// Not of 0.
inline ForeignVector unit(const ForeignVector &vector) {
    const double size = length(vector);
    return {vector[0] / size, vector[1] / size, vector[2] / size};
}

} // namespace cli
