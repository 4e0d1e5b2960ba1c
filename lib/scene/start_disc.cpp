#include "lib/scene/start_disc.h"

#include <algorithm>
#include <cmath>

namespace pt {

// Let the centre of a ball lie at a distance a before the plane of the disc and c from its axis. The points of the disc
// have distances between the roots of a^2 + max(c - radius, 0)^2 and a^2 + (c + radius)^2 from it. A ball that moves,
// and a capsule, is taken to be larger by half its way, unless all of the way is too far from the disc. Float32 can
// tell the sides apart up to a share of the size of the ball or, for a huge ball, of its distance.
bool divides_start(const MovingBall &ball, const Camera &camera, double slack) {
    if (camera.start_radius == 0.0 || !may_hold_origin(ball, camera.start_radius + slack))
        return false;
    const glm::dvec3 centre = ball.open + 0.5 * ball.way;
    const double along = glm::dot(centre, camera.forward);
    const double across = glm::length(centre - along * camera.forward);
    const double nearest = std::hypot(along, std::max(across - camera.start_radius, 0.0));
    const double farthest = std::hypot(along, across + camera.start_radius);
    const double height = std::abs(glm::length(centre) - ball.radius);
    const double rounded = side_margin * std::min(ball.radius, std::max(height, camera.start_radius));
    const double margin = rounded + 0.5 * glm::length(ball.way) + slack;
    return nearest <= ball.radius + margin && farthest >= ball.radius - margin;
}

bool divides_start(const CurvedPlane &flat, const Camera &camera) {
    const double sine = glm::length(glm::cross(flat.normal, camera.forward));
    return camera.start_radius > 0.0 && std::abs(flat.offset) <= camera.start_radius * (sine + side_margin);
}

} // namespace pt
