// Compares spheres with what is near them; see hidden_surfaces.h.
#include "lib/kernel/hidden_surfaces.h"

#include <algorithm>

namespace pt {

namespace {

// Adds a margin, so that float32 cannot see it differently.
double with_margin(double length) {
    return length * (1.0 + side_margin);
}

} // namespace

// Both move evenly, so one passes the other on a straight line, and the greatest distance is at one of its ends.
bool lies_apart(const MovingBall &ball, const MovingBall &surface) {
    const glm::dvec3 from = ball.open - surface.open;
    const glm::dvec3 way = ball.way - surface.way;
    const double farthest = std::max(glm::length(from), glm::length(from + way));
    const bool is_beside = least_distance(from, way) > with_margin(ball.radius + surface.radius);
    const bool is_within = with_margin(farthest + ball.radius) < surface.radius;
    return is_beside || is_within;
}

namespace {

// A capsule does not move: all of its balls are there at once, and a ball about all of them stands for it.
MovingBall ball_about(const SeenSphere &sphere) {
    if (!sphere.swept)
        return static_cast<const MovingBall &>(sphere);
    const glm::dvec3 half = 0.5 * sphere.way;
    return {sphere.open + half, glm::dvec3(0.0), sphere.radius + glm::length(half)};
}

bool lies_apart(const MovingBall &ball, const SeenSphere &surface) {
    if (!surface.swept)
        return pt::lies_apart(ball, static_cast<const MovingBall &>(surface));
    const MovingBall about = ball_about(surface);
    return least_distance(ball.open - about.open, ball.way) > with_margin(ball.radius + about.radius);
}

} // namespace

bool lies_apart(const MovingBall &ball, const CurvedPlane &flat) {
    const double open = glm::dot(flat.normal, ball.open) + flat.offset;
    const double close = glm::dot(flat.normal, ball.close()) + flat.offset;
    const double radius = with_margin(ball.radius);
    return std::min(open, close) > radius || std::max(open, close) < -radius;
}

bool lies_apart(const MovingBall &ball, const PointBox &box) {
    const double radius = with_margin(ball.radius);
    const glm::dvec3 low = glm::min(ball.open, ball.close()) - radius;
    const glm::dvec3 high = glm::max(ball.open, ball.close()) + radius;
    return glm::any(glm::lessThan(high, box.low)) || glm::any(glm::lessThan(box.high, low));
}

bool lies_apart(const SeenSphere &hidden, const SeenScene &scene, const SphereTree *tree, const Camera &camera) {
    const MovingBall ball = ball_about(hidden);
    const auto is_in_touch = [&](const auto &surface) { return !surface.hidden && !lies_apart(ball, surface); };
    const auto of_scene = [&](const PointBox &box) {
        return PointBox{box.low - camera.position, box.high - camera.position};
    };
    return !scene.any_surface(is_in_touch) && (tree == nullptr || lies_apart(ball, of_scene(tree->bounds())));
}

} // namespace pt
