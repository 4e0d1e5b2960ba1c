// A ball that moves along a straight line, and questions about it that do not depend on its material.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace pt {

struct MovingBall {
    glm::dvec3 open; // the centre at first
    glm::dvec3 way;  // of the centre from then to the end
    double radius;

    glm::dvec3 close() const { return open + way; }
};

// If a point is nearer to a surface than this share of the radius, float32 may put it on the other side.
inline constexpr double side_margin = 0x1p-16;

// Balls that differ by more than this share of their radii are different, however far away they are. A distance d is
// known to a few roundings, 2^-22 d. That amounts to this share only from d = 2^20 radii on, where the rounding of a
// centre, 2^-24 d, is a 16th of the radius and shows whatever is done about twins.
inline constexpr double two_spheres = 0.25;

// The least distance from the origin of a point that starts at open and moves along a straight line.
inline double least_distance(const glm::dvec3 &open, const glm::dvec3 &way) {
    const double length = glm::dot(way, way);
    const double nearest = length > 0.0 ? std::clamp(-glm::dot(open, way) / length, 0.0, 1.0) : 0.0;
    return glm::length(open + nearest * way);
}

// Whether the origin is inside the ball at any time, or so close to it that float32 cannot tell. slack: how much
// farther away still counts.
inline bool may_hold_origin(const MovingBall &ball, double slack = 0.0) {
    return !(least_distance(ball.open, ball.way) > ball.radius * (1.0 + side_margin) + slack);
}

// Whether the two balls nearly coincide: no point of either is far from the other, compared with their size.
inline bool nearly_coincide(const MovingBall &a, const MovingBall &b) {
    const double apart = std::max(glm::length(a.open - b.open), glm::length(a.close() - b.close()));
    return apart + std::abs(a.radius - b.radius) < two_spheres * std::min(a.radius, b.radius);
}

// Whether a ball, at some time, may nearly coincide with one of the balls that make up a capsule.
inline bool nearly_coincides_within(const MovingBall &ball, const MovingBall &capsule) {
    const double apart = std::max(least_distance(capsule.open - ball.open, capsule.way) - glm::length(ball.way), 0.0);
    return apart + std::abs(ball.radius - capsule.radius) < two_spheres * std::min(ball.radius, capsule.radius);
}

} // namespace pt
