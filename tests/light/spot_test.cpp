#include "shaders/specialization.h"
#include "spots.spv.h"
#include "tests/kernel/probe.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace {

struct DrawnSpot {
    glm::vec3 direction;
    float density;
    std::uint32_t surface;
    float distance; // 0 if blocked
    std::array<std::uint32_t, 2> reserved;
};

constexpr std::uint32_t first_lamp = 0;
constexpr std::uint32_t second_lamp = 1;
constexpr std::uint32_t sphere = 2;
constexpr std::uint32_t floor_plane = 3;
constexpr std::uint32_t surface_count = 4;
const std::array<glm::vec4, surface_count> shapes = {glm::vec4(1.0F, 0.6F, -3.0F, 0.2F),
                                                     glm::vec4(-1.5F, 2.0F, -4.0F, 0.1F),
                                                     glm::vec4(-1.0F, 0.7F, -1.5F, 0.7F), glm::vec4(0, 1, 0, 0)};
constexpr float glow = -1.0F;

struct SpotOf {
    std::uint32_t lamp;
    std::uint32_t surface;
    float glossiness;
};

std::vector<DrawnSpot> draw_spots(const std::vector<SpotOf> &spots, std::uint32_t count) {
    struct {
        glm::vec4 position, normal;
        std::uint32_t surface, seed, count;
    } push{glm::vec4(2.5F, 1.1F, -0.5F, 0), glm::vec4(-0.8F, 0, -0.6F, 0), 0xffffffffU, 5, count};
    std::array<std::uint32_t, pt::gpu::CONSTANT_COUNT> constants{};
    constants[pt::gpu::ID_SPHERE_COUNT] = floor_plane;
    constants[pt::gpu::ID_PLANE_COUNT] = 1;
    constants[pt::gpu::ID_LAMP_COUNT] = 2;
    constants[pt::gpu::ID_MAX_PATH_LENGTH] = 3;
    constants[pt::gpu::ID_ESTIMATOR] = PT_ESTIMATOR_MIS;
    constants[pt::gpu::ID_GLOSS] = 1;
    constants[pt::gpu::ID_SPOT_COUNT] = static_cast<std::uint32_t>(spots.size());
    constants[pt::gpu::ID_SCENE_SOURCE] = pt::gpu::SCENE_IN_UNIFORM;
    constants[pt::gpu::ID_POINT_BLOCKS] = probe_point_blocks;
    constants[pt::gpu::ID_SAMPLER] = PT_SAMPLER_RANDOM;
    std::vector<glm::vec4> scene(4 * surface_count + spots.size());
    for (std::uint32_t i = 0; i < surface_count; ++i)
        scene[i] = shapes[i];
    scene[surface_count + first_lamp] = glm::vec4(20);
    scene[surface_count + second_lamp] = glm::vec4(40);
    for (std::size_t i = 0; i < spots.size(); ++i)
        scene[4 * surface_count + i] = {std::bit_cast<float>(pt::gpu::MATERIAL_INDEX_BITS + spots[i].lamp),
                                        std::bit_cast<float>(pt::gpu::MATERIAL_INDEX_BITS + spots[i].surface), 0.5F,
                                        spots[i].glossiness};
    Probe probe(spots_spirv(), sizeof push, constants);
    probe.set_scene(scene);
    return probe.run<DrawnSpot>({}, count, push, count);
}

// Compares the solid angle of a cone within the surface with the mean of 1 / (density * density_error) over the cone.
// Returns the difference in standard errors.
double solid_angle_deviate(const std::vector<DrawnSpot> &drawn, std::uint32_t surface, double radius,
                           double density_error) {
    const auto counts = [&](const DrawnSpot &sample) { return sample.surface == surface && sample.distance > 0.0F; };
    glm::dvec3 sum(0);
    for (const DrawnSpot &sample : drawn)
        if (counts(sample))
            sum += glm::dvec3(sample.direction);
    const glm::dvec3 middle = glm::normalize(sum);
    std::vector<double> inverses;
    std::size_t within = 0;
    for (const DrawnSpot &sample : drawn) {
        const bool is_in_cone = counts(sample) && glm::length(glm::dvec3(sample.direction) - middle) < radius;
        inverses.push_back(is_in_cone ? 1.0 / (double{sample.density} * density_error) : 0.0);
        within += is_in_cone ? 1 : 0;
    }
    EXPECT_GT(within, drawn.size() / 50) << "too few to tell anything";
    const statistics::Moments moments = statistics::moments(inverses);
    const double solid_angle = std::numbers::pi * radius * radius; // solid angle of the cap from its chord (Archimedes)
    return (moments.mean - solid_angle) / std::sqrt(moments.variance / static_cast<double>(drawn.size()));
}

TEST(Spots, DirectionsFollowTheStatedDensity) {
    constexpr std::uint32_t draws = 1U << 20;
    const struct {
        const char *name;
        std::vector<SpotOf> spots;
        std::uint32_t surface;
        double radius; // chord of a cone that lies within the surface and has no very rare directions
    } cases[] = {{"two glows", {{first_lamp, floor_plane, glow}, {second_lamp, floor_plane, glow}}, floor_plane, 0.1},
                 {"an image in a plane", {{first_lamp, floor_plane, 200}}, floor_plane, 0.05},
                 {"two images in a sphere", {{first_lamp, sphere, 50}, {second_lamp, sphere, 50}}, sphere, 0.015},
                 {"one of many",
                  {{first_lamp, floor_plane, glow},
                   {second_lamp, sphere, 100},
                   {first_lamp, sphere, 100},
                   {second_lamp, floor_plane, 300}},
                  floor_plane,
                  0.05},
                 {"sharp", {{second_lamp, sphere, 1e5F}}, sphere, 0.002}};
    const double bound = statistics::normal_quantile(0.5e-6 / std::size(cases)); // one false alarm in a million
    for (const auto &[name, spots, surface, radius] : cases) {
        SCOPED_TRACE(name);
        const std::vector<DrawnSpot> drawn = draw_spots(spots, draws);
        EXPECT_LT(std::abs(solid_angle_deviate(drawn, surface, radius, 1.0)), bound);
        EXPECT_GT(std::abs(solid_angle_deviate(drawn, surface, radius, 1.03)), bound) << "3% too dense must show";
        EXPECT_GT(std::abs(solid_angle_deviate(drawn, surface, radius, 0.97)), bound) << "3% too thin must show";
    }
}

} // namespace
