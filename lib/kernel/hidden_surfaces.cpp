// Compares spheres with what is near them; see hidden_surfaces.h.
#include "lib/kernel/hidden_surfaces.h"

#include <algorithm>

namespace pt {

bool lies_apart(const MovingBall &ball, const CurvedPlane &flat) {
    const double open = glm::dot(flat.normal, ball.open) + flat.offset;
    const double close = glm::dot(flat.normal, ball.close()) + flat.offset;
    const double radius = with_margin(ball.radius);
    return std::min(open, close) > radius || std::max(open, close) < -radius;
}

bool lies_apart(const MovingBall &ball, const PointBox &box) {
    const PointBox about = box_about({ball.open, ball.way, with_margin(ball.radius)});
    return glm::any(glm::lessThan(about.high, box.low)) || glm::any(glm::lessThan(box.high, about.low));
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
