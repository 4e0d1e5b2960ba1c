// Decides which spheres are seen as planes with a curvature; see curved_plane.h.
#include "lib/scene/curved_plane.h"

#include "lib/base/error.h"
#include "lib/base/rules.h"

#include <cmath>
#include <string>

namespace pt {

namespace {

// A sphere counts as nearly flat if its radius is this many times its distance from the camera: below, its centre and
// radius cost at most 5 of the 24 bits that a hit near the camera has.
constexpr double nearly_flat = 32.0;

// A lamp that is held by its centre is sampled by the cone that it subtends; one held as a plane is found by directions
// alone. That serves as well where it fills half of the view, but sees its rim, of which few directions know, with more
// noise, so it begins where the centre's precision ends: here its surface is off by 2^-24 R, 1/256 of the distance.
constexpr double nearly_flat_lamp = 65536.0;

glm::dvec3 way_of(const Sphere &sphere, const Camera &camera) {
    return (camera.shutter_close - camera.shutter_open) * sphere.motion;
}

// From the centre, as the shutter opens, to the camera.
glm::dvec3 from_center(const Sphere &sphere, const Camera &camera) {
    return camera.position - (sphere.center + camera.shutter_open * sphere.motion);
}

} // namespace

CurvedPlane curved_plane(const Plane &plane, const Camera &camera) {
    const double offset = plane.offset + glm::dot(plane.normal, camera.position);
    return {offset < 0.0 ? -plane.normal : plane.normal, std::abs(offset), 0.0, glm::dvec3(0.0)};
}

// One that moves is seen as if the camera moved the other way, so what it moves counts like a distance.
std::optional<CurvedPlane> curved_plane(const Sphere &sphere, const Material &material, const Camera &camera) {
    const glm::dvec3 to_camera = from_center(sphere, camera);
    const glm::dvec3 way = way_of(sphere, camera);
    const double distance = glm::length(to_camera);
    const double offset = distance - sphere.radius;
    const bool is_lamp = material.emission != glm::vec3(0.0F);
    const bool is_flat = sphere.radius > (is_lamp ? nearly_flat_lamp : nearly_flat) * std::abs(offset);
    if (!is_flat || !(sphere.radius > nearly_flat * glm::length(way)))
        return std::nullopt;
    return CurvedPlane{to_camera / distance, offset, 1.0 / sphere.radius, way};
}

// Held by its centre, its surface is off by 2^-24 of the radius. Where that is more than 1/256 of its distance, as for
// lamps, the picture would be wrong while it is so near.
void require_held_motions(const Scene &scene, const Camera &camera) {
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
        const Sphere &sphere = scene.spheres[i];
        const double offset = glm::length(from_center(sphere, camera)) - sphere.radius;
        const double way = glm::length(way_of(sphere, camera));
        const bool huge = sphere.radius > nearly_flat_lamp * std::abs(offset);
        if (huge && sphere.radius <= nearly_flat * way)
            throw Error(PT_ERROR_UNSUPPORTED, "spheres[" + std::to_string(i) +
                                                  "].motion = " + number_text(sphere.motion) +
                                                  ": a sphere whose surface, as the shutter opens, is nearer to the "
                                                  "camera than a 65536th of its radius (" +
                                                  number_text(sphere.radius) +
                                                  ") must move less than a 32nd of it while the shutter is open");
    }
}

} // namespace pt
