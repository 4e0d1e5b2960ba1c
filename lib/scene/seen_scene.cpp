// Looks at a scene; see seen_scene.h.
#include "lib/scene/seen_scene.h"

#include "lib/base/error.h"
#include "lib/base/rules.h"

#include <string>

namespace pt {

SeenScene seen_scene(const Scene &scene, const Camera &camera) {
    SeenScene seen;
    seen.spheres.reserve(scene.spheres.size());
    for (const Sphere &sphere : scene.spheres)
        seen.spheres.emplace_back(sphere, scene.materials[sphere.material], camera,
                                  static_cast<std::uint32_t>(seen.spheres.size()));
    seen.planes.reserve(scene.planes.size());
    for (const Plane &plane : scene.planes)
        seen.planes.push_back(curved_plane(plane, scene.materials[plane.material], camera,
                                           static_cast<std::uint32_t>(seen.planes.size())));
    return seen;
}

void require_held_motions(const SeenScene &seen, const Scene &scene, const Camera &camera) {
    for (std::size_t i = 0; i < seen.spheres.size(); ++i)
        if (moves_too_far(seen.spheres[i], camera)) {
            const SpherePlace place = place_of_sphere(scene, i);
            throw Error(
                PT_ERROR_UNSUPPORTED,
                BrokenRule{.subject = place.subject,
                           .index = place.index,
                           .member = "motion",
                           .component = place.component,
                           .value = number_text(scene.spheres[i].motion),
                           .rule = "a sphere whose surface, as the shutter opens, is nearer to " +
                                   std::string(camera.is_orthographic()
                                                   ? "where parallel rays start, in a view whose half diagonal is less,"
                                                   : "the camera") +
                                   " than a 65536th of its radius (" + number_text(scene.spheres[i].radius) +
                                   ") must move less than a 32nd of it while the shutter is open"});
        }
}

} // namespace pt
