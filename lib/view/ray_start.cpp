#include "lib/view/ray_start.h"

#include "lib/base/error.h"
#include "lib/base/rules.h"
#include "lib/view/seen_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace pt {

namespace {

// Squared distances of farther starts would overflow float32.
constexpr double farthest_start = 6e18;

// In narrower pixels, the error of directions, 2^-24, exceeds 1/1024 of a pixel.
constexpr double narrow_pixel = 0x1p-14; // side of a pixel at distance 1

// The pyramid of rays through the center of the lens, and the cone around it.
struct View {
    std::array<glm::dvec3, 4> corners; // directions, scaled to 1 along `forward`
    glm::dvec3 forward;
    double half_angle;
    double aside; // largest distance of lens rays from the pinhole ray

    View(const Camera &camera, const RenderSettings &settings) : forward(camera.forward), aside(camera.lens_radius) {
        const double up = camera.tan_half_fov;
        const double right = up * settings.width / settings.height;
        half_angle = std::atan(std::hypot(up, right));
        corners = {forward - right * camera.right - up * camera.up, forward + right * camera.right - up * camera.up,
                   forward - right * camera.right + up * camera.up, forward + right * camera.right + up * camera.up};
    }
};

// The depth -offset / (normal . direction) is least at a corner.
double nearest_depth(const CurvedPlane &plane, const View &view) {
    const double offset = std::max(plane.offset - view.aside, 0.0);
    double nearest = offset == 0.0 ? 0.0 : out_of_view;
    for (const glm::dvec3 &corner : view.corners) {
        const double depth = -offset / glm::dot(plane.normal, corner);
        nearest = depth > 0.0 ? std::min(nearest, depth) : nearest;
    }
    return nearest;
}

double angle_from_middle(const glm::dvec3 &point, const View &view) {
    const double along = glm::dot(point, view.forward);
    return std::atan2(glm::length(point - along * view.forward), along);
}

// The cone's direction nearest to the center hits the ball first. With b = d cos(angle), the distance is b - sqrt(r^2 -
// d^2 sin^2(angle)) = (d^2 - r^2) / (b + sqrt(r^2 - d^2 sin^2(angle))). The second form avoids cancellation for small
// distant balls.
double depth_of_ball(const glm::dvec3 &centre, double radius, const View &view) {
    const double distance = glm::length(centre);
    const double power = (distance - radius) * (distance + radius);
    if (power <= 0.0)
        return 0.0;
    const double angle = angle_from_middle(centre, view);
    const double nearest = std::max(angle - view.half_angle, 0.0);
    const double across = distance * std::sin(nearest);
    const double squared_half_chord = radius * radius - across * across;
    const double b = distance * std::cos(nearest);
    if (b <= 0.0 || squared_half_chord < 0.0)
        return out_of_view;
    return power / (b + std::sqrt(squared_half_chord)) * std::cos(view.half_angle);
}

bool starts_within(const glm::dvec3 &centre, double radius, const View &) {
    return glm::length(centre) <= radius;
}

// If rays start inside, the direction farthest from the center hits the sphere first.
double depth_from_within(const glm::dvec3 &centre, double radius, const View &view) {
    const double distance = glm::length(centre);
    const double angle = angle_from_middle(centre, view);
    const double farthest = std::min(angle + view.half_angle, std::numbers::pi);
    const double across = distance * std::sin(farthest);
    const double half_chord = std::sqrt(radius * radius - across * across);
    return (distance * std::cos(farthest) + half_chord) * std::cos(view.half_angle);
}

// In perspective, depth_of_ball() of the whole motion is good enough.
double depth_on_way(const MovingBall &, const View &) {
    return 0.0;
}

// The box of parallel rays, and the cylinder around it.
struct ParallelView {
    glm::dvec3 half_right;
    glm::dvec3 half_up;
    glm::dvec3 forward;
    double radius;
    static constexpr double aside = 0.0;

    ParallelView(const Camera &camera, const RenderSettings &settings) :
        half_right(0.5 * camera.vertical_extent * settings.width / settings.height * camera.right),
        half_up(0.5 * camera.vertical_extent * camera.up),
        forward(camera.forward),
        radius(std::hypot(glm::length(half_right), glm::length(half_up))) {}
};

// The depth -height / (normal . forward) is least at a corner.
double nearest_depth(const CurvedPlane &plane, const ParallelView &view) {
    const double across =
        std::abs(glm::dot(plane.normal, view.half_right)) + std::abs(glm::dot(plane.normal, view.half_up));
    if (plane.offset <= across)
        return 0.0;
    const double slope = -glm::dot(plane.normal, view.forward);
    return slope > 0.0 ? (plane.offset - across) / slope : out_of_view;
}

// The line of the cylinder that is nearest to the center hits the ball first. Let a be the center's depth and c its
// distance from the line. The depth is a - sqrt(r^2 - c^2) = (a^2 + c^2 - r^2) / (a + sqrt(r^2 - c^2)). The second form
// avoids cancellation.
double depth_of_ball(const glm::dvec3 &centre, double radius, const ParallelView &view) {
    const double depth = glm::dot(centre, view.forward);
    const double across = glm::length(centre - depth * view.forward);
    const double least = std::max(across - view.radius, 0.0);
    if (least >= radius)
        return out_of_view;
    const double half_chord = std::sqrt((radius - least) * (radius + least));
    if (depth + half_chord <= 0.0)
        return out_of_view;
    const double distance = glm::length(centre);
    const double power = (distance - radius) * (distance + radius) - (across - least) * (across + least);
    return depth > 0.0 && power > 0.0 ? power / (depth + half_chord) : 0.0;
}

// Returns the largest distance of a ray from the parallel line through the center.
double most_across(const glm::dvec3 &centre, const ParallelView &view) {
    return glm::length(centre - glm::dot(centre, view.forward) * view.forward) + view.radius;
}

bool starts_within(const glm::dvec3 &centre, double radius, const ParallelView &view) {
    return std::hypot(glm::dot(centre, view.forward), most_across(centre, view)) < radius;
}

double depth_from_within(const glm::dvec3 &centre, double radius, const ParallelView &view) {
    const double most = most_across(centre, view);
    return glm::dot(centre, view.forward) + std::sqrt((radius - most) * (radius + most));
}

// The depth is least at an end of the motion. The ball around the whole motion would give a worse bound.
double depth_on_way(const MovingBall &sphere, const ParallelView &view) {
    const double open = glm::dot(sphere.open, view.forward);
    return open + std::min(glm::dot(sphere.way, view.forward), 0.0) - sphere.radius;
}

template <typename AnyView>
double depth_of_region(const MovingBall &ball, const AnyView &view) {
    const double radius = ball.radius + 0.5 * glm::length(ball.way) + view.aside;
    const double depth = depth_of_ball(ball.open + 0.5 * ball.way, radius, view);
    return ball.way == glm::dvec3(0.0) ? depth : std::max(depth, depth_on_way(ball, view));
}

// A ray that starts inside hits the far wall. Starts stay `margin` radii away from the surface.
template <typename AnyView>
double depth_of_sphere(const MovingBall &sphere, const AnyView &view, double margin = 0.0) {
    const double inner = sphere.radius * (1.0 - margin) - view.aside;
    if (sphere.way == glm::dvec3(0.0) && starts_within(sphere.open, inner, view))
        return depth_from_within(sphere.open, inner, view);
    return depth_of_region({sphere.open, sphere.way, sphere.radius * (1.0 + margin)}, view);
}

// Returns a lower bound. Rays start so far from tree spheres that float32 can decide on which side they start.
template <typename AnyView>
double first_depth(const Scene &scene, const SphereTree *tree, const Camera &camera, const AnyView &view) {
    double depth = out_of_view;
    for (const Sphere &sphere : scene.spheres)
        depth = std::min(depth, depth_of_sphere(seen_ball(sphere.ball(), camera), view));
    for (const Plane &plane : scene.planes)
        depth = std::min(depth, nearest_depth(curved_plane(plane, scene.materials[plane.material], camera), view));
    if (tree)
        depth = std::min(
            depth, tree->least(
                           camera, [&](const MovingBall &region) { return depth_of_region(region, view); },
                           [&](const MovingBall &sphere) { return depth_of_sphere(sphere, view, 2.0 * side_margin); })
                       .number);
    return depth;
}

// Squared distances of a wider view would overflow float32.
void require_held_view(const Camera &camera, const RenderSettings &settings) {
    const double width = camera.vertical_extent * settings.width / settings.height;
    if (width > max_length)
        throw Error(PT_ERROR_UNSUPPORTED,
                    BrokenRule{.subject = "camera",
                               .member = "vertical_extent",
                               .value = number_text(camera.vertical_extent),
                               .rule = "the view's width, vertical_extent times the image's width / height, must be "
                                       "at most 1e18, is " +
                                       number_text(width)});
}

// Rays start before the first surface, by a little more than the view's width, so that no visible surface intersects
// the disc of starts.
Camera starting_in_parallel(const Scene &scene, const SphereTree *tree, const Camera &camera,
                            const RenderSettings &settings) {
    require_held_view(camera, settings);
    const ParallelView view(camera, settings);
    const double depth = first_depth(scene, tree, camera, view);
    Camera ahead = camera;
    ahead.start_radius = view.radius;
    if (depth <= farthest_start)
        ahead.start_distance = std::max(depth - 1.25 * view.radius, 0.0);
    ahead.position += ahead.start_distance * camera.forward;
    return ahead;
}

} // namespace

Camera starting_ahead(const Scene &scene, const SphereTree *tree, const Camera &camera,
                      const RenderSettings &settings) {
    if (camera.is_orthographic())
        return starting_in_parallel(scene, tree, camera, settings);
    Camera ahead = camera;
    ahead.start_radius = camera.lens_radius;
    if (2.0 * camera.tan_half_fov / settings.height > narrow_pixel)
        return ahead;
    const View view(camera, settings);
    const double depth = first_depth(scene, tree, camera, view);
    if (depth > farthest_start)
        return ahead;
    // Rays start before the first surface, by the lens's radius and the view's width, so that rounding puts no start
    // behind it. A lens's rays must start before the focus.
    const double tangent = std::tan(view.half_angle);
    ahead.start_distance = std::max((1.0 - tangent) * depth - camera.lens_radius, 0.0);
    if (camera.has_lens()) {
        ahead.start_distance = std::min(ahead.start_distance, camera.focus);
        ahead.start_radius = tangent * ahead.start_distance + ahead.spread(ahead.start_distance);
    }
    ahead.position += ahead.start_distance * camera.forward;
    return ahead;
}

std::function<double(const MovingBall &)> depths_in_view(const Camera &camera, const RenderSettings &settings) {
    if (camera.is_orthographic())
        return [view = ParallelView(camera, settings)](const MovingBall &ball) { return depth_of_region(ball, view); };
    return [view = View(camera, settings)](const MovingBall &ball) { return depth_of_region(ball, view); };
}

gpu::CameraView camera_view(const Camera &camera, const RenderSettings &settings) {
    gpu::CameraView view{};
    view.right = camera.right;
    view.up = camera.up;
    view.width = settings.width;
    view.height = settings.height;
    view.forward = camera.forward;
    if (camera.is_orthographic()) {
        view.start_scale = static_cast<float>(camera.vertical_extent / settings.height);
    } else {
        const double image_distance = settings.height / (2.0 * camera.tan_half_fov);
        view.forward = camera.forward * image_distance;
        if (camera.has_lens()) {
            view.lens_radius = static_cast<float>(camera.spread(camera.start_distance));
            view.lens_blur = static_cast<float>(camera.lens_radius / camera.focus * image_distance);
        }
        view.start_scale = static_cast<float>(camera.start_distance * (2.0 * camera.tan_half_fov / settings.height));
    }
    return view;
}

} // namespace pt
