#include "cli/selftest/selftest_directions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <numbers>

namespace cli {
namespace {

// A right device fails one of the 18 checks once in a million: each with probability 5.6e-8, on both sides of a normal
// distribution, which means of 2^18 independent samples have.
constexpr double most_sigmas = 5.43;
constexpr std::uint32_t direction_image_side = 512;
constexpr double pixel_count = 1.0 * direction_image_side * direction_image_side;
constexpr int wall_count = 4;

pt_material grey(float diffuse, float specular, float glossiness, float emission) {
    pt_material material{};
    std::ranges::fill(material.diffuse, diffuse);
    std::ranges::fill(material.specular, specular);
    std::ranges::fill(material.emission, emission);
    material.glossiness = glossiness;
    return material;
}

// Of directions with density proportional to c^power.
double mean_of_power(double power, double exponent) {
    return (power + 1.0) / (power + 1.0 + exponent);
}

SelftestCheck check(const std::string &name, double measured, double exact, double variance) {
    const double error = std::abs(measured - exact) / std::sqrt(variance / pixel_count);
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%.9g, exact is %.9g", measured, exact);
    return {"directions", name,    std::isfinite(error) ? error : std::numeric_limits<double>::infinity(),
            most_sigmas,  "sigma", text.data()};
}

SelftestScene floor_scene(const char *name, std::uint32_t estimator, const pt_material &floor) {
    SelftestScene scene{};
    scene.name = name;
    scene.materials = {floor, grey(0, 0, 0, 1), grey(0, 0, 0, 0)};
    scene.spheres = {{{0, 0, 0}, 1000, {0, 0, 0}, 1, 0}};
    scene.planes = {{{0, 1, 0}, 0, 0, 0}};
    scene.camera.struct_size = sizeof(pt_camera);
    scene.camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    scene.camera.position[1] = 1;
    scene.camera.up[2] = 1;
    scene.camera.vertical_extent = 1e-4;
    scene.render.struct_size = sizeof(pt_render);
    scene.render.width = direction_image_side;
    scene.render.height = direction_image_side;
    scene.render.max_path_length = 2;
    scene.render.estimator = estimator;
    scene.render.sampler = PT_SAMPLER_RANDOM; // the pixels' numbers are independent
    scene.sample_count = 1;
    return scene;
}

} // namespace

std::vector<SelftestCheck> DirectionScene::judge(std::span<const float> radiance) const {
    double sum = 0.0;
    double square_sum = 0.0;
    double seen = 0.0;
    for (std::size_t i = 0; i < radiance.size(); i += 3) {
        const double cosine = static_cast<double>(radiance[i]) / scale;
        sum += cosine;
        square_sum += cosine * cosine;
        seen += cosine > 0.0 ? 1.0 : 0.0;
    }
    if (has_wall)
        return {check(scene.name, seen / pixel_count, 0.5, 0.25)};
    const double mean = mean_of_power(power, 1.0);
    const double square = mean_of_power(power, 2.0);
    return {
        check(scene.name + ": cosine", sum / pixel_count, mean, square - mean * mean),
        check(scene.name + ": square", square_sum / pixel_count, square, mean_of_power(power, 4.0) - square * square)};
}

// With f the reflection, a sample is f * c over the density: 2 c of a white diffuse floor whose directions are uniform;
// (n + 2) / 2 c^n of a lobe of exponent n whose directions follow the cosine; (n + 2) / (n + 1) c of one that they
// follow.
std::vector<DirectionScene> direction_scenes() {
    constexpr double n = 20.0;
    const std::array open = {
        DirectionScene{floor_scene("hemisphere, uniform", PT_ESTIMATOR_UNIFORM, grey(1, 0, 0, 0)), 0.0, 2.0, false},
        DirectionScene{floor_scene("hemisphere, by cosine", PT_ESTIMATOR_COSINE, grey(0, 1, 1, 0)), 1.0, 1.5, false},
        DirectionScene{floor_scene("Phong lobe, n = 20", PT_ESTIMATOR_BSDF, grey(0, 1, static_cast<float>(n), 0)), n,
                       (n + 2.0) / (n + 1.0), false}};
    std::vector<DirectionScene> scenes;
    for (const DirectionScene &kind : open) {
        scenes.push_back(kind);
        for (int wall = 0; wall < wall_count; ++wall) {
            const double angle = std::numbers::pi * wall / wall_count;
            DirectionScene walled = kind;
            walled.has_wall = true;
            walled.scene.name += ": side " + std::to_string(180 * wall / wall_count);
            walled.scene.planes.push_back({{std::cos(angle), 0, std::sin(angle)}, 1, 2, 0});
            scenes.push_back(walled);
        }
    }
    return scenes;
}

} // namespace cli
