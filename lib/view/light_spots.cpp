#include "lib/view/light_spots.h"

#include "lib/view/scene_blocks.h"
#include "shaders/specialization.h"

#include <algorithm>
#include <cmath>

namespace pt {

namespace {

// A glow is worth a ray if the plane is bright, and the lamp is near the plane without covering it. The limits are
// empirical.
constexpr double largest_glow_height = 0.2; // a fraction of the farthest plane's height
constexpr double least_glow_height = 1.5;   // multiple of the lamp's radius
constexpr double least_glow_diffuse = 0.35;
// A mirror image is worth a ray if it is bright and small. The image's width is 1 / glossiness plus the width of the
// lamp.
constexpr double least_image_specular = 0.45;
constexpr double widest_image = 0.02;

double mean_of_color(const glm::vec3 &color) {
    return (static_cast<double>(color.r) + color.g + color.b) / 3.0;
}

float reflectance(const glm::vec3 &color) {
    return static_cast<float>(mean_of_color(color));
}

double height_above(const CurvedPlane &plane, const MovingBall &lamp) {
    return std::abs(glm::dot(plane.normal, lamp.open) + plane.offset);
}

bool shows_image(const Material &material, const MovingBall &lamp, double distance) {
    const double sine = lamp.radius / distance;
    return mean_of_color(material.specular) >= least_image_specular && distance > lamp.radius &&
           1.0 / material.glossiness + sine * sine / 4.0 <= widest_image;
}

void add_images_in_spheres(std::vector<LightSpot> &spots, std::uint32_t lamp, const KernelSurfaces &surfaces,
                           const std::vector<Material> &materials) {
    const MovingBall &ball = surfaces.spheres[lamp];
    for (std::uint32_t i = surfaces.lamp_count + surfaces.sky_count; i < surfaces.spheres.size(); ++i) {
        const SeenSphere &sphere = surfaces.spheres[i];
        const Material &material = materials[sphere.material];
        if (sphere.kind == Kind::ball &&
            shows_image(material, ball, glm::length(sphere.open - ball.open) - sphere.radius))
            spots.push_back({lamp, i, reflectance(material.specular), material.glossiness});
    }
}

void add_spots_of_planes(std::vector<LightSpot> &spots, std::uint32_t lamp, const KernelSurfaces &surfaces,
                         const std::vector<Material> &materials) {
    const MovingBall &ball = surfaces.spheres[lamp];
    double farthest = 0.0;
    for (const CurvedPlane &plane : surfaces.planes)
        farthest = std::max(farthest, height_above(plane, ball));
    auto surface = static_cast<std::uint32_t>(surfaces.spheres.size());
    for (const CurvedPlane &plane : surfaces.planes) {
        const Material &material = materials[plane.material];
        const double height = height_above(plane, ball);
        const bool flat = plane.curvature == 0.0;
        if (flat && height >= least_glow_height * ball.radius && height <= largest_glow_height * farthest &&
            mean_of_color(material.diffuse) >= least_glow_diffuse)
            spots.push_back({lamp, surface, reflectance(material.diffuse), -1.0F});
        if (flat && shows_image(material, ball, height))
            spots.push_back({lamp, surface, reflectance(material.specular), material.glossiness});
        ++surface;
    }
}

} // namespace

std::vector<LightSpot> light_spots(const KernelSurfaces &surfaces, const std::vector<Material> &materials,
                                   const Features &features) {
    const bool are_of_use = samples_lamps(features) && features[gpu::ID_MAX_PATH_LENGTH] > 2;
    if (!are_of_use || features[gpu::ID_LAMP_COUNT] > gpu::EVERY_LAMP_LIMIT || !features.scene_in_uniform() ||
        SceneBlocks(features).word_count + gpu::SPOT_LIMIT > gpu::UNIFORM_SCENE_WORDS)
        return {};
    std::vector<LightSpot> spots;
    for (std::uint32_t lamp = 0; lamp < surfaces.lamp_count; ++lamp) {
        add_images_in_spheres(spots, lamp, surfaces, materials);
        add_spots_of_planes(spots, lamp, surfaces, materials);
    }
    if (spots.size() > gpu::SPOT_LIMIT)
        spots.clear();
    return spots;
}

} // namespace pt
