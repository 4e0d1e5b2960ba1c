#include "lib/scene/scene_digest.h"

#include "lib/base/digest.h"

namespace pt {

std::string digest_of(const Scene &scene) {
    Digest digest;
    for (const std::size_t count : {scene.materials.size(), scene.spheres.size(), scene.planes.size()})
        digest.add(std::uint64_t{count});
    for (const Material &material : scene.materials) {
        digest.add(material.diffuse);
        digest.add(material.specular);
        digest.add(material.emission);
        digest.add(static_cast<double>(material.glossiness));
    }
    for (const Sphere &sphere : scene.spheres) {
        digest.add(sphere.center);
        digest.add(sphere.radius);
        digest.add(sphere.motion);
        digest.add(std::uint64_t{sphere.material});
    }
    for (const Plane &plane : scene.planes) {
        digest.add(plane.normal);
        digest.add(plane.offset);
        digest.add(std::uint64_t{plane.material});
    }
    return digest.text();
}

} // namespace pt
