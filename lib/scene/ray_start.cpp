// Finds how near the first surface in view can be; see ray_start.h.
#include "lib/scene/ray_start.h"

#include "lib/base/error.h"
#include "lib/base/rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace pt {

namespace {

constexpr double out_of_view = std::numeric_limits<double>::infinity();

// Farther than any sphere may be, whose centre, way and camera have components up to 1e18; planes that are all but
// along the view are met farther still. From a start beyond it the squares of distances would not be numbers of
// float32.
constexpr double farthest_start = 6e18;

// Components of a direction are off by 2^-24: from here on, by more than 1/1024 of a pixel.
constexpr double narrow_pixel = 0x1p-14; // its side at distance 1

// The pyramid of the rays of an image, and the cone about it.
struct View {
    std::array<glm::dvec3, 4> corners; // at depth 1
    glm::dvec3 forward;
    double half_angle;

    View(const Camera &camera, const RenderSettings &settings) : forward(camera.forward) {
        const double up = camera.tan_half_fov;
        const double right = up * settings.width / settings.height;
        half_angle = std::atan(std::hypot(up, right));
        corners = {forward - right * camera.right - up * camera.up, forward + right * camera.right - up * camera.up,
                   forward - right * camera.right + up * camera.up, forward + right * camera.right + up * camera.up};
    }
};

// A plane's depth along a direction of depth 1 is -offset / (normal . direction), least at a corner.
double nearest_depth(const CurvedPlane &plane, const View &view) {
    double nearest = plane.offset == 0.0 ? 0.0 : out_of_view;
    for (const glm::dvec3 &corner : view.corners) {
        const double depth = -plane.offset / glm::dot(plane.normal, corner);
        nearest = depth > 0.0 ? std::min(nearest, depth) : nearest;
    }
    return nearest;
}

// Of the directions of the cone, the one nearest to the sphere's centre meets it first, if the camera is outside; if it
// is inside, the one farthest from the centre. With b = d cos(angle) the roots are b -+ sqrt(r^2 - d^2 sin^2(angle)),
// whose product is d^2 - r^2: nothing cancels for small far spheres. A sphere that moves is taken for the ball about
// its way.
double nearest_depth(const SeenSphere &sphere, const View &view) {
    const glm::dvec3 centre = sphere.open + 0.5 * sphere.way;
    const double radius = sphere.radius + 0.5 * glm::length(sphere.way);
    const double distance = glm::length(centre);
    const double along = glm::dot(centre, view.forward);
    const double angle = std::atan2(glm::length(centre - along * view.forward), along);
    const double power = (distance - radius) * (distance + radius); // of the camera with respect to the sphere
    if (power <= 0.0) {
        if (sphere.way != glm::dvec3(0.0))
            return 0.0;
        const double farthest = std::min(angle + view.half_angle, std::numbers::pi);
        const double across = distance * std::sin(farthest);
        const double half_chord = std::sqrt(radius * radius - across * across);
        return (distance * std::cos(farthest) + half_chord) * std::cos(view.half_angle);
    }
    const double nearest = std::max(angle - view.half_angle, 0.0);
    const double across = distance * std::sin(nearest);
    const double squared_half_chord = radius * radius - across * across;
    const double b = distance * std::cos(nearest);
    if (b <= 0.0 || squared_half_chord < 0.0)
        return out_of_view;
    return power / (b + std::sqrt(squared_half_chord)) * std::cos(view.half_angle);
}

// The box of the parallel rays of an image, and the cylinder about it.
struct ParallelView {
    glm::dvec3 half_right;
    glm::dvec3 half_up;
    glm::dvec3 forward;
    double radius;

    ParallelView(const Camera &camera, const RenderSettings &settings) :
        half_right(0.5 * camera.vertical_extent * settings.width / settings.height * camera.right),
        half_up(0.5 * camera.vertical_extent * camera.up),
        forward(camera.forward),
        radius(std::hypot(glm::length(half_right), glm::length(half_up))) {}
};

// A plane's depth, -height / (normal . forward) for the height of where a ray starts, changes evenly across the view:
// it is least at a corner. Where rays start on both sides there is no room before the plane.
double nearest_depth(const CurvedPlane &plane, const ParallelView &view) {
    const double across =
        std::abs(glm::dot(plane.normal, view.half_right)) + std::abs(glm::dot(plane.normal, view.half_up));
    if (plane.offset <= across)
        return 0.0;
    const double slope = -glm::dot(plane.normal, view.forward);
    return slope > 0.0 ? (plane.offset - across) / slope : out_of_view;
}

// Of the lines of the cylinder those nearest to the centre meet the sphere first, at a - sqrt(r^2 - c^2) for a centre
// at depth a and c from the line; if all start inside, those farthest from it, at a + sqrt(r^2 - c^2). The first is
// (a^2 + c^2 - r^2) / (a + sqrt(r^2 - c^2)), in which nothing cancels for small far spheres: the centre is at a
// distance d, and d^2 - r^2 is a product. A sphere that moves is taken for the ball about its way.
double nearest_depth_of_ball(const SeenSphere &sphere, const ParallelView &view) {
    const glm::dvec3 centre = sphere.open + 0.5 * sphere.way;
    const double radius = sphere.radius + 0.5 * glm::length(sphere.way);
    const double depth = glm::dot(centre, view.forward);
    const double across = glm::length(centre - depth * view.forward);
    const double least = std::max(across - view.radius, 0.0);
    if (least >= radius)
        return out_of_view;
    const double half_chord = std::sqrt((radius - least) * (radius + least));
    if (depth + half_chord <= 0.0)
        return out_of_view; // behind
    const double distance = glm::length(centre);
    const double power = (distance - radius) * (distance + radius) - (across - least) * (across + least);
    if (depth > 0.0 && power > 0.0)
        return power / (depth + half_chord);
    const double most = across + view.radius;
    if (sphere.way != glm::dvec3(0.0) || std::hypot(depth, most) >= radius)
        return 0.0;
    return depth + std::sqrt((radius - most) * (radius + most));
}

// The ball about the way of one that moves across the view reaches before all that it passes.
double nearest_depth(const SeenSphere &sphere, const ParallelView &view) {
    const double ball = nearest_depth_of_ball(sphere, view);
    if (sphere.way == glm::dvec3(0.0))
        return ball;
    const double open = glm::dot(sphere.open, view.forward);
    return std::max(ball, open + std::min(glm::dot(sphere.way, view.forward), 0.0) - sphere.radius);
}

// Of what is wider the squares of distances would not be numbers of float32.
void require_held_view(const Camera &camera, const RenderSettings &settings) {
    const double width = camera.vertical_extent * settings.width / settings.height;
    if (width > max_length)
        throw Error(PT_ERROR_UNSUPPORTED,
                    BrokenRule{.subject = "camera",
                               .member = "vertical_extent",
                               .value = number_text(camera.vertical_extent),
                               .rule = "the width of the view, which is as many times that of the image as the height "
                                       "is, must be at most 1e18, is " +
                                       number_text(width)});
}

// Stays as far before the first surface as the view is wide, and a little more, so that no surface in view divides the
// disc.
Camera starting_in_parallel(const SeenScene &seen, const Camera &camera, const RenderSettings &settings) {
    require_held_view(camera, settings);
    const ParallelView view(camera, settings);
    double depth = out_of_view;
    for (const SeenSphere &sphere : seen.spheres)
        depth = std::min(depth, nearest_depth(sphere, view));
    for (const CurvedPlane &plane : seen.planes)
        depth = std::min(depth, nearest_depth(plane, view));
    Camera ahead = camera;
    ahead.start_radius = view.radius;
    if (depth <= farthest_start)
        ahead.start_distance = std::max(depth - 1.25 * view.radius, 0.0);
    ahead.position += ahead.start_distance * camera.forward;
    return ahead;
}

} // namespace

Camera starting_ahead(const SeenScene &seen, const Camera &camera, const RenderSettings &settings) {
    if (camera.is_orthographic())
        return starting_in_parallel(seen, camera, settings);
    if (2.0 * camera.tan_half_fov / settings.height > narrow_pixel)
        return camera;
    const View view(camera, settings);
    double depth = out_of_view;
    for (const SeenSphere &sphere : seen.spheres)
        depth = std::min(depth, nearest_depth(sphere, view));
    for (const CurvedPlane &plane : seen.planes)
        depth = std::min(depth, nearest_depth(plane, view));
    if (depth > farthest_start)
        return camera;
    // Keeps a distance from the first surface as large as the view is wide there, so that rounding puts no start behind
    // the surface.
    Camera ahead = camera;
    ahead.start_distance = std::max(1.0 - std::tan(view.half_angle), 0.0) * depth;
    ahead.position += ahead.start_distance * camera.forward;
    return ahead;
}

} // namespace pt
