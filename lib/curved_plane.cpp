// Decides which spheres are seen as planes with a curvature; see curved_plane.h.
#include "curved_plane.h"

#include <cmath>

namespace pt {

namespace {

// A sphere counts as nearly flat if its radius is this many times its distance from the camera: below, its centre and
// radius cost at most 5 of the 24 bits that a hit near the camera has.
constexpr double nearly_flat = 32.0;

// A lamp that is held by its centre is sampled by the cone that it subtends; one held as a plane is found by directions
// alone. That serves as well where it fills half of the view, but sees its rim, of which few directions know, with more
// noise, so it begins where the centre's precision ends: here its surface is off by 2^-24 R, 1/256 of the distance.
constexpr double nearly_flat_lamp = 65536.0;

bool moves(const Sphere &sphere, const Camera &camera) {
    return sphere.motion != glm::dvec3(0.0) && camera.shutter_close > camera.shutter_open;
}

} // namespace

CurvedPlane curved_plane(const Plane &plane, const Camera &camera) {
    return {plane.normal, plane.offset + glm::dot(plane.normal, camera.position), 0.0};
}

std::optional<CurvedPlane> curved_plane(const Sphere &sphere, const Material &material, const Camera &camera) {
    if (moves(sphere, camera))
        return std::nullopt;
    const glm::dvec3 from_center = camera.position - (sphere.center + camera.shutter_open * sphere.motion);
    const double distance = glm::length(from_center);
    const double offset = distance - sphere.radius;
    const bool is_lamp = material.emission != glm::vec3(0.0F);
    if (!(sphere.radius > (is_lamp ? nearly_flat_lamp : nearly_flat) * std::abs(offset)))
        return std::nullopt;
    return CurvedPlane{from_center / distance, offset, 1.0 / sphere.radius};
}

} // namespace pt
