// Finds how near the first surface in view can be; see ray_start.h.
#include "lib/scene/ray_start.h"

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

} // namespace

Camera starting_ahead(const SeenScene &seen, const Camera &camera, const RenderSettings &settings) {
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
