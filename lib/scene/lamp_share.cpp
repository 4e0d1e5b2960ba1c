#include "lib/scene/lamp_share.h"

#include "lib/scene/seen_sphere.h"

#include <algorithm>
#include <cmath>

namespace pt {

double smallest_lamp_share(const Scene &scene, const Camera &camera) {
    double smallest = 1.0;
    for (const Sphere &sphere : scene.spheres) {
        const SeenSphere seen(sphere, scene.materials[sphere.material], camera);
        if (!seen.emits || seen.height() <= 0.0)
            continue;
        // (1 - cos a) / 2 of the cone around the sphere; as sin^2 a / (2 (1 + cos a)) small ones lose no digits.
        const double sine = seen.radius / seen.distance;
        const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
        smallest = std::min(smallest, sine * sine / (2.0 * (1.0 + cosine)));
    }
    return smallest;
}

} // namespace pt
