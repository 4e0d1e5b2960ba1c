#include "lib/scene/lamp_share.h"

#include "lib/scene/seen_sphere.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pt {

namespace {

// Of the lamps' light; what less would be missed hardly shows.
constexpr double least_light = 0.01;

struct Lamp {
    double share; // of all directions
    double light;
};

// (1 - cos a) / 2 of the cone around the sphere; as sin^2 a / (2 (1 + cos a)) small ones lose no digits.
double share_of(const SeenSphere &sphere) {
    const double sine = sphere.radius / sphere.distance;
    const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
    return sine * sine / (2.0 * (1.0 + cosine));
}

} // namespace

std::optional<double> smallest_lamp_share(const Scene &scene, const Camera &camera) {
    std::vector<Lamp> lamps;
    double light = 0.0;
    for (const Sphere &sphere : scene.spheres) {
        const Material &material = scene.materials[sphere.material];
        const SeenSphere seen(sphere, material, camera);
        if (!seen.emits || seen.height() <= 0.0)
            continue;
        const glm::dvec3 emission(material.emission);
        const double share = share_of(seen);
        lamps.push_back({share, share * std::max({emission.r, emission.g, emission.b})});
        light += lamps.back().light;
    }
    std::optional<double> smallest;
    for (const Lamp &lamp : lamps)
        if (lamp.light >= least_light * light)
            smallest = std::min(smallest.value_or(lamp.share), lamp.share);
    return smallest;
}

} // namespace pt
