// Chooses spots; see light_spots.h.
#include "lib/kernel/light_spots.h"

#include "lib/kernel/scene_blocks.h"
#include "shaders/specialization.h"

#include <algorithm>
#include <cmath>

namespace pt {

namespace {

// Found by trial on the scenes of cli/scenes (tests/bench/NOTEBOOK.md). A glow is worth a ray where the lamp is nearer
// to the plane than a fifth of its distance from the farthest one, yet does not cover what it lights, and the plane is
// not dark.
constexpr double largest_glow_height = 0.2; // over the lamp's height above the farthest plane
constexpr double least_glow_height = 1.5;   // over the lamp's radius
constexpr double least_glow_diffuse = 0.35; // mean of R, G and B
// A mirror image is worth a spot if it is bright and small. Its size is 1 / n for a lobe of glossiness n, plus what the
// lamp's width adds.
constexpr double least_image_specular = 0.45; // mean of R, G and B
constexpr double widest_image = 0.02;

double mean_of_color(const glm::vec3 &color) {
    return (static_cast<double>(color.r) + color.g + color.b) / 3.0;
}

double height_above(const CurvedPlane &plane, const SeenSphere &lamp) {
    return std::abs(glm::dot(plane.normal, lamp.open) + plane.offset);
}

bool shows_image(const Material &material, const SeenSphere &lamp, double distance) {
    const double sine = lamp.radius / distance;
    return mean_of_color(material.specular) >= least_image_specular && distance > lamp.radius &&
           1.0 / material.glossiness + sine * sine / 4.0 <= widest_image;
}

class SpotChoice {
public:
    SpotChoice(const KernelSurfaces &surfaces, const std::vector<Material> &materials) :
        surfaces_(surfaces),
        materials_(materials) {}

    std::vector<LightSpot> spots() {
        for (std::uint32_t lamp = 0; lamp < surfaces_.lamp_count; ++lamp) {
            add_images_in_spheres(lamp);
            add_spots_of_planes(lamp);
        }
        return spots_;
    }

private:
    void add_images_in_spheres(std::uint32_t lamp) {
        const SeenSphere &ball = surfaces_.spheres[lamp];
        for (std::uint32_t i = surfaces_.lamp_count + surfaces_.sky_count; i < surfaces_.spheres.size(); ++i) {
            const SeenSphere &sphere = surfaces_.spheres[i];
            const Material &material = materials_[sphere.material];
            if (sphere.kind == Kind::ball &&
                shows_image(material, ball, glm::length(sphere.open - ball.open) - sphere.radius))
                add(lamp, i, material.specular, material.glossiness);
        }
    }

    void add_spots_of_planes(std::uint32_t lamp) {
        const SeenSphere &ball = surfaces_.spheres[lamp];
        double farthest = 0.0;
        for (const CurvedPlane &plane : surfaces_.planes)
            farthest = std::max(farthest, height_above(plane, ball));
        for (std::uint32_t i = 0; i < surfaces_.planes.size(); ++i) {
            const CurvedPlane &plane = surfaces_.planes[i];
            const Material &material = materials_[plane.material];
            const double height = height_above(plane, ball);
            if (plane.curvature != 0.0)
                continue;
            if (height >= least_glow_height * ball.radius && height <= largest_glow_height * farthest &&
                mean_of_color(material.diffuse) >= least_glow_diffuse)
                add(lamp, surface_of_plane(i), material.diffuse, -1.0F);
            if (shows_image(material, ball, height))
                add(lamp, surface_of_plane(i), material.specular, material.glossiness);
        }
    }

    void add(std::uint32_t lamp, std::uint32_t surface, const glm::vec3 &reflectance, float glossiness) {
        spots_.push_back({lamp, surface, static_cast<float>(mean_of_color(reflectance)), glossiness});
    }

    std::uint32_t surface_of_plane(std::uint32_t plane) const {
        return static_cast<std::uint32_t>(surfaces_.spheres.size()) + plane;
    }

    const KernelSurfaces &surfaces_;
    const std::vector<Material> &materials_;
    std::vector<LightSpot> spots_;
};

} // namespace

std::vector<LightSpot> light_spots(const KernelSurfaces &surfaces, const std::vector<Material> &materials,
                                   const Features &features) {
    const bool are_of_use = samples_lamps(features) && features[gpu::ID_MAX_PATH_LENGTH] > 2;
    if (!are_of_use || features[gpu::ID_LAMP_COUNT] > gpu::EVERY_LAMP_LIMIT || !features.scene_in_uniform() ||
        SceneBlocks(features).word_count + gpu::SPOT_LIMIT > gpu::UNIFORM_SCENE_WORDS)
        return {};
    std::vector<LightSpot> spots = SpotChoice(surfaces, materials).spots();
    if (spots.size() > gpu::SPOT_LIMIT)
        spots.clear();
    return spots;
}

} // namespace pt
