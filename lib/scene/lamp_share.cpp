#include "lib/scene/lamp_share.h"

#include "lib/scene/seen_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace pt {

namespace {

// Of the lamps' light; what less would be missed hardly shows.
constexpr double least_light = 0.01;

struct Lamp {
    SeenSphere sphere;
    double share; // of all directions
    double light;
};

// (1 - cos a) / 2 of the cone around the sphere; as sin^2 a / (2 (1 + cos a)) small ones lose no digits.
double share_of(const SeenSphere &sphere) {
    const double sine = sphere.radius / sphere.distance;
    const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
    return sine * sine / (2.0 * (1.0 + cosine));
}

std::vector<Lamp> lamps_that_matter(const Scene &scene, const Camera &camera) {
    std::vector<Lamp> lamps;
    double light = 0.0;
    for (const Sphere &sphere : scene.spheres) {
        const Material &material = scene.materials[sphere.material];
        const double emission = std::max({material.emission.r, material.emission.g, material.emission.b});
        if (!(emission > 0.0))
            continue;
        const SeenSphere seen(sphere, material, camera);
        if (seen.height() <= 0.0)
            continue;
        const double share = share_of(seen);
        lamps.push_back({seen, share, share * emission});
        light += lamps.back().light;
    }
    std::erase_if(lamps, [light](const Lamp &lamp) { return lamp.light < least_light * light; });
    return lamps;
}

} // namespace

std::optional<double> smallest_lamp_share(const Scene &scene, const Camera &camera) {
    std::optional<double> smallest;
    for (const Lamp &lamp : lamps_that_matter(scene, camera))
        smallest = std::min(smallest.value_or(lamp.share), lamp.share);
    return smallest;
}

std::optional<double> pixels_of_smallest_lamp_in_view(const Scene &scene, const Camera &camera, std::uint32_t width,
                                                      std::uint32_t height) {
    std::optional<double> smallest;
    for (const auto &[sphere, share, light] : lamps_that_matter(scene, camera)) {
        const double depth = glm::dot(sphere.open, camera.forward);
        const double half_height =
            camera.is_orthographic() ? 0.5 * camera.vertical_extent : depth * camera.tan_half_fov;
        const bool in_view = depth > 0.0 && std::abs(glm::dot(sphere.open, camera.up)) <= half_height &&
                             std::abs(glm::dot(sphere.open, camera.right)) * height <= half_height * width;
        const double radius = 0.5 * height * sphere.radius / half_height; // pixels
        if (in_view && !sphere.hidden)
            smallest = std::min(smallest.value_or(INFINITY), std::numbers::pi * radius * radius);
    }
    return smallest;
}

} // namespace pt
