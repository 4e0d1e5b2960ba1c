#include "lib/view/seen_scene.h"

#include "lib/base/error.h"
#include "lib/base/rules.h"

#include <cmath>

namespace pt {

namespace {

// Spheres with a larger ratio of radius to distance are nearly flat. Below this ratio, a hit loses at most 5 of
// float32's 24 bits.
constexpr double nearly_flat = 32.0;

// The ratio for lamps is larger, because curved planes cannot be sampled as lamps. At this ratio the error of the
// surface, 2^-24 of the radius, is 1/256 of the distance.
constexpr double nearly_flat_lamp = 65536.0;

bool is_large(const SeenSphere &sphere, double ratio) {
    return sphere.kind == Kind::ball && sphere.radius > ratio * std::abs(sphere.height());
}

bool moves_little(const SeenSphere &sphere) {
    return sphere.radius > nearly_flat * glm::length(sphere.way);
}

// Whether the surface is too near to be stored as a sphere, and moves too far to be stored as a plane. Errors that are
// small compared with the disc of ray starts are harmless.
bool moves_too_far(const SeenSphere &sphere, const Camera &camera) {
    return is_large(sphere, nearly_flat_lamp) && sphere.radius > nearly_flat_lamp * camera.start_radius &&
           !moves_little(sphere);
}

} // namespace

SeenSphere::SeenSphere(const Sphere &sphere, const Material &of_sphere, const Camera &camera, std::uint32_t of_index) :
    MovingBall(seen_ball(sphere.ball(), camera)),
    distance(glm::length(open)),
    material(sphere.material),
    index(of_index),
    emits(pt::emits(of_sphere)),
    hidden(of_sphere.hidden),
    is_flat(is_large(*this, emits ? nearly_flat_lamp : nearly_flat) && moves_little(*this)) {}

CurvedPlane curved_plane(const Plane &plane, const Material &of_plane, const Camera &camera, std::uint32_t index) {
    const double offset = plane.offset + glm::dot(plane.normal, camera.position);
    return {offset < 0.0 ? -plane.normal : plane.normal,
            std::abs(offset),
            0.0,
            glm::dvec3(0.0),
            plane.material,
            index,
            of_plane.hidden};
}

CurvedPlane curved_plane(const SeenSphere &sphere) {
    return {-sphere.open / sphere.distance,
            sphere.height(),
            1.0 / sphere.radius,
            sphere.way,
            sphere.material,
            sphere.index,
            sphere.hidden};
}

SeenScene seen_scene(const Scene &scene, const Camera &camera) {
    SeenScene seen;
    for (std::uint32_t i = 0; i < scene.spheres.size(); ++i)
        seen.spheres.emplace_back(scene.spheres[i], scene.materials[scene.spheres[i].material], camera, i);
    for (std::uint32_t i = 0; i < scene.planes.size(); ++i)
        seen.planes.push_back(curved_plane(scene.planes[i], scene.materials[scene.planes[i].material], camera, i));
    return seen;
}

void require_held_motions(const SeenScene &seen, const Scene &scene, const Camera &camera) {
    const auto held =
        std::ranges::find_if(seen.spheres, [&](const SeenSphere &sphere) { return moves_too_far(sphere, camera); });
    if (held == seen.spheres.end())
        return;
    const Sphere &sphere = scene.spheres[held->index];
    const SpherePlace place = place_of_sphere(scene, held->index);
    throw Error(
        PT_ERROR_UNSUPPORTED,
        BrokenRule{.subject = place.subject,
                   .index = place.index,
                   .member = "motion",
                   .component = place.component,
                   .value = number_text(sphere.motion),
                   .rule = "must be less than a 32nd of the radius (" + number_text(sphere.radius) +
                           ") while the shutter is open, because the surface is nearer than a 65536th of it to " +
                           (camera.is_orthographic() ? "the start of parallel rays, in a view of smaller size"
                                                     : "the camera")});
}

bool divides_start(const CurvedPlane &flat, const Camera &camera) {
    const double sine = glm::length(glm::cross(flat.normal, camera.forward));
    return camera.start_radius > 0.0 && std::abs(flat.offset) <= camera.start_radius * (sine + side_margin);
}

} // namespace pt
