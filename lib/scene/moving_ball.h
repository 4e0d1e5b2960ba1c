// A ball that moves along a line, or a capsule, which occupies the whole line at once.
#pragma once

#include "lib/base/digest.h"
#include "lib/scene/camera.h"
#include "shaders/gpu_layout.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pt {

enum class Kind : std::uint8_t { ball = gpu::KIND_BALL, capsule = gpu::KIND_CAPSULE };

class Kinds {
public:
    void add(Kind kind) { bits_ |= static_cast<std::uint32_t>(kind); }
    void add(Kinds others) { bits_ |= others.bits_; }
    std::uint32_t bits() const { return bits_; }
    bool have_ways() const { return bits_ > gpu::KIND_BALL; }

private:
    std::uint32_t bits_ = 0;
};

struct MovingBall {
    glm::dvec3 open;
    glm::dvec3 way;
    double radius;
    Kind kind = Kind::ball;

    glm::dvec3 close() const { return open + way; }
    bool moves() const { return kind == Kind::ball && way != glm::dvec3(0.0); }
};

struct PointBox {
    glm::dvec3 low;
    glm::dvec3 high;
};

inline PointBox box_about(const MovingBall &ball) {
    return {glm::min(ball.open, ball.close()) - ball.radius, glm::max(ball.open, ball.close()) + ball.radius};
}

inline MovingBall seen_ball(const MovingBall &ball, const Camera &camera) {
    if (ball.kind != Kind::ball)
        return {ball.open - camera.position, ball.way, ball.radius, ball.kind};
    return {ball.open + camera.shutter_open * ball.way - camera.position,
            (camera.shutter_close - camera.shutter_open) * ball.way, ball.radius};
}

// Float32 may be wrong about the side of a point that is within this fraction of the radius.
inline constexpr double side_margin = 0x1p-16;

// Balls that differ by more than this fraction of their radii are distinct.
inline constexpr double two_spheres = 0.25;

inline double with_margin(double length) {
    return length * (1.0 + side_margin);
}

inline double least_distance(const glm::dvec3 &open, const glm::dvec3 &way) {
    const double length = glm::dot(way, way);
    const double nearest = length > 0.0 ? std::clamp(-glm::dot(open, way) / length, 0.0, 1.0) : 0.0;
    return glm::length(open + nearest * way);
}

// Whether the origin is at any time inside the ball. True if float32 cannot decide.
inline bool may_hold_origin(const MovingBall &ball, double slack = 0.0) {
    return !(least_distance(ball.open, ball.way) > with_margin(ball.radius) + slack);
}

// Whether parallel rays may start on both sides of a ball. True if float32 cannot decide.
//
// Rays start on a disc. Let a be the center's distance from the disc's plane, and c its distance from the disc's axis.
// Squared distances between the center and points of the disc are a^2 + max(c - start_radius, 0)^2 to a^2 + (c +
// start_radius)^2. A moving ball is replaced by the ball around its motion.
inline bool divides_start(const MovingBall &ball, const Camera &camera, double slack = 0.0) {
    if (camera.start_radius == 0.0 || !may_hold_origin(ball, camera.start_radius + slack))
        return false;
    const glm::dvec3 center = ball.open + 0.5 * ball.way;
    const double along = glm::dot(center, camera.forward);
    const double across = glm::length(center - along * camera.forward);
    const double nearest = std::hypot(along, std::max(across - camera.start_radius, 0.0));
    const double farthest = std::hypot(along, across + camera.start_radius);
    const double height = std::abs(glm::length(center) - ball.radius);
    const double rounded = side_margin * std::min(ball.radius, std::max(height, camera.start_radius));
    const double margin = rounded + 0.5 * glm::length(ball.way) + slack;
    return nearest <= ball.radius + margin && farthest >= ball.radius - margin;
}

// Whether both surfaces, or an end ball of a capsule and the other surface, nearly coincide.
inline bool nearly_coincide(const MovingBall &ball, const MovingBall &other) {
    const double apart = other.kind == Kind::capsule
                             ? std::max(least_distance(other.open - ball.open, other.way) - glm::length(ball.way), 0.0)
                             : std::max(glm::length(ball.open - other.open), glm::length(ball.close() - other.close()));
    return apart + std::abs(ball.radius - other.radius) < two_spheres * std::min(ball.radius, other.radius);
}

inline MovingBall ball_about(const MovingBall &ball) {
    if (ball.kind == Kind::ball)
        return ball;
    const glm::dvec3 half = 0.5 * ball.way;
    return {ball.open + half, glm::dvec3(0.0), ball.radius + glm::length(half)};
}

// Whether the ball never touches or contains the surface. Relative motion is straight, so the largest distance is at an
// end.
inline bool lies_apart(const MovingBall &ball, const MovingBall &surface) {
    const MovingBall about = ball_about(surface);
    const glm::dvec3 from = ball.open - about.open;
    const glm::dvec3 way = ball.way - about.way;
    const double farthest = std::max(glm::length(from), glm::length(from + way));
    const bool is_beside = least_distance(from, way) > with_margin(ball.radius + about.radius);
    const bool is_within = surface.kind == Kind::ball && with_margin(farthest + ball.radius) < surface.radius;
    return is_beside || is_within;
}

// The ball's word in the scene buffer's block `motion` (gpu_layout.h). A capsule becomes a ball if 1 / length
// overflows.
inline glm::vec4 way_word(const MovingBall &ball) {
    const glm::vec3 rounded = glm::vec3(ball.way) + 0.0F; // -0 becomes +0, so that twins have equal words
    if (ball.kind == Kind::ball)
        return {rounded, 0.0F};
    const auto inverse = static_cast<float>(1.0 / glm::length(ball.way));
    return std::isfinite(inverse) ? glm::vec4(rounded, inverse) : glm::vec4(0.0F);
}

inline MovingBall surface_of(const glm::dvec3 &open, double radius, const glm::vec4 &way) {
    return {open, glm::dvec3(way), radius, way.w > 0.0F ? Kind::capsule : Kind::ball};
}

// Balls add nothing, so that scenes without capsules still match old films.
inline void add_kind(Digest &digest, Kind kind) {
    if (kind != Kind::ball)
        digest.add(std::uint64_t{static_cast<std::uint8_t>(kind)} - 1);
}

} // namespace pt
