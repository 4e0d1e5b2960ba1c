#include "lib/scene/lamp_share.h"

#include "lib/scene/seen_sphere.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pt {

namespace {

// The share of the light of all lamps below which a lamp is not missed.
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

std::vector<Lamp> lamps_that_matter(std::span<const Sphere> spheres, std::span<const Material> materials,
                                    const Camera &camera) {
    std::vector<Lamp> lamps;
    double light = 0.0;
    for (const Sphere &sphere : spheres) {
        const Material &material = materials[sphere.material];
        const double emission = std::max({material.emission.r, material.emission.g, material.emission.b});
        if (!(emission > 0.0))
            continue;
        const SeenSphere seen(sphere, material, camera);
        if (seen.height() <= 0.0)
            continue;
        const double share = share_of(seen);
        lamps.push_back({share, share * emission});
        light += lamps.back().light;
    }
    std::erase_if(lamps, [light](const Lamp &lamp) { return lamp.light < least_light * light; });
    return lamps;
}

} // namespace

std::optional<double> smallest_lamp_share(std::span<const Sphere> lamps, std::span<const Material> materials,
                                          const Camera &camera) {
    std::optional<double> smallest;
    for (const Lamp &lamp : lamps_that_matter(lamps, materials, camera))
        smallest = std::min(smallest.value_or(lamp.share), lamp.share);
    return smallest;
}

} // namespace pt
