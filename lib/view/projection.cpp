#include "lib/view/projection.h"

#include "lib/view/seen_scene.h"

#include <algorithm>

namespace pt {

gpu::CameraView Projection::rays() const {
    gpu::CameraView view{};
    view.right = camera_.right;
    view.up = camera_.up;
    view.width = width_;
    view.height = height_;
    view.forward = camera_.forward;
    set_rays(view);
    return view;
}

bool BoundedProjection::is_ahead(const glm::dvec3 &center, double radius) const {
    return glm::dot(center, camera_.forward) > radius;
}

double BoundedProjection::least_depth(const MovingBall &ball) const {
    const double radius = ball.radius + 0.5 * glm::length(ball.way) + aside();
    const double depth = depth_of_ball(ball.open + 0.5 * ball.way, radius);
    return ball.way == glm::dvec3(0.0) ? depth : std::max(depth, depth_on_way(ball));
}

// A ray that starts inside hits the far wall. Starts stay `margin` radii away from the surface.
double BoundedProjection::depth_of_sphere(const MovingBall &sphere, double margin) const {
    const double inner = sphere.radius * (1.0 - margin) - aside();
    if (sphere.way == glm::dvec3(0.0) && starts_within(sphere.open, inner))
        return depth_from_within(sphere.open, inner);
    return least_depth({sphere.open, sphere.way, sphere.radius * (1.0 + margin)});
}

// Squared distances of farther starts would overflow float32.
constexpr double farthest_start = 6e18;

double BoundedProjection::first_depth(const Scene &scene, const SphereTree *tree) const {
    double depth = out_of_view;
    for (const Sphere &sphere : scene.spheres)
        depth = std::min(depth, depth_of_sphere(seen_ball(sphere.ball(), camera_)));
    for (const Plane &plane : scene.planes)
        depth = std::min(depth, depth_of_plane(curved_plane(plane, scene.materials[plane.material], camera_)));
    if (tree)
        depth = std::min(depth,
                         tree->least(
                                 camera_, [&](const MovingBall &region) { return least_depth(region); },
                                 [&](const MovingBall &sphere) { return depth_of_sphere(sphere, 2.0 * side_margin); })
                             .number);
    return depth <= farthest_start ? depth : out_of_view;
}

} // namespace pt
