// Where parallel camera rays start.
#include "lib/kernel/ray_start.h"
#include "lib/scene/seen_sphere.h"
#include "lib/scene/start_disc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace parallel_start {

namespace {

const glm::dvec3 position = {1, 2, 3};
const pt::RenderSettings square{64, 64, 2, 0, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_RANDOM, 0, 64};

pt::Camera parallel_along(const glm::dvec3 &direction, double extent) {
    const glm::dvec3 forward = glm::normalize(direction);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
    return {position, right, glm::cross(right, forward), forward, 0.0, 0.0, 1.0, extent};
}

double start_before(const std::vector<pt::Sphere> &spheres, const std::vector<pt::Plane> &planes,
                    const pt::Camera &camera) {
    pt::Scene scene;
    scene.materials = {{glm::vec3(0.5F), glm::vec3(0), glm::vec3(0), 0}};
    scene.spheres = spheres;
    scene.planes = planes;
    return pt::starting_ahead(scene, nullptr, camera, square).start_distance;
}

// Five eighths of a view's diagonal are 1.25 of its half: of a square of side 2, that is 1.25 sqrt(2).
TEST(ParallelStart, IsFiveEighthsOfTheDiagonalBeforeTheFirstSurface) {
    const pt::Camera camera = parallel_along({0.48, 0.6, -0.64}, 2.0);
    const double before = 1.25 * std::sqrt(2.0);
    const glm::dvec3 place = position + 1e4 * camera.forward;
    EXPECT_NEAR(start_before({{place, 3, {0, 0, 0}, 0}}, {}, camera), 1e4 - 3 - before, 1e-9);
    EXPECT_NEAR(start_before({}, {{camera.forward, -glm::dot(camera.forward, place), 0}}, camera), 1e4 - before, 1e-9);
    const pt::Sphere across{place, 3, 1000.0 * camera.right, 0};
    EXPECT_NEAR(start_before({across}, {}, camera), 1e4 - 3 - before, 1e-9) << "it comes no nearer on its way";
    const pt::Sphere towards{place, 3, -100.0 * camera.forward, 0};
    EXPECT_NEAR(start_before({towards}, {}, camera), 1e4 - 103 - before, 1e-9);
}

// Otherwise vertices would tell the sides of all surfaces, which those that coincide in part confuse.
TEST(ParallelStart, IsOnOneSideOfALongCapsuleAcrossTheView) {
    pt::Camera camera = parallel_along({0.48, 0.6, -0.64}, 2.0);
    pt::Sphere capsule{position - 500.0 * camera.right, 0.25, 1000.0 * camera.right, 0, true};
    camera.start_radius = std::sqrt(2.0);
    for (const double before : {1.25 * camera.start_radius, 0.9 * camera.start_radius, 0.0}) {
        capsule.center = position - 500.0 * camera.right + (0.25 + before) * camera.forward;
        EXPECT_EQ(pt::divides_start(pt::seen_ball(capsule, camera), camera), before < camera.start_radius) << before;
    }
}

TEST(ParallelStart, IsAtThePositionWhereNothingIsInView) {
    const pt::Camera camera = parallel_along({0, 0, -1}, 2.0);
    EXPECT_EQ(start_before({{position + glm::dvec3(0, 4, -50), 2, {0, 0, 0}, 0}}, {}, camera), 0.0) << "beside it";
    EXPECT_EQ(start_before({{position + glm::dvec3(0, 0, 50), 2, {0, 0, 0}, 0}}, {}, camera), 0.0) << "behind";
    EXPECT_EQ(start_before({}, {{{0, 1, 0}, -1.5, 0}}, camera), 0.0) << "a plane divides the view";
}

// No ray of the view may meet a surface before it starts: random ones against random spheres, which move, and planes.
TEST(ParallelStart, NothingInViewIsBeforeIt) {
    std::mt19937 engine(5);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 53>(engine);
    };
    int near_misses = 0;
    for (int round = 0; round < 400; ++round) {
        const double extent = std::pow(10.0, uniform(-2, 4));
        const pt::Camera camera = parallel_along({uniform(-1, 1), uniform(-1, 1), -1.5}, extent);
        const double distance = extent * std::pow(10.0, uniform(-1, 3));
        const double radius = extent * std::pow(10.0, uniform(-2, 2));
        const glm::dvec3 place = distance * camera.forward + extent * uniform(-1, 1) * camera.right;
        const bool moves = round % 4 == 1;
        const glm::dvec3 way =
            moves ? radius * glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) : glm::dvec3(0);
        const glm::dvec3 normal = glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
        const bool is_plane = round % 4 == 0;
        const double start = is_plane ? start_before({}, {{normal, -glm::dot(normal, position + place), 0}}, camera)
                                      : start_before({{position + place, radius, way, 0}}, {}, camera);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 origin = 0.5 * extent * (uniform(-1, 1) * camera.right + uniform(-1, 1) * camera.up);
            double depth = std::numeric_limits<double>::infinity();
            if (is_plane) {
                const double met = glm::dot(normal, place - origin) / glm::dot(normal, camera.forward);
                depth = met > 0 ? met : depth;
            } else {
                const glm::dvec3 centre = place + uniform(0, 1) * way - origin;
                const double b = glm::dot(centre, camera.forward);
                const double square_of_half = radius * radius - glm::dot(centre, centre) + b * b;
                const double half = std::sqrt(std::max(square_of_half, 0.0));
                if (square_of_half > 0 && b + half > 0)
                    depth = b - half > 0 ? b - half : b + half;
            }
            EXPECT_GE(depth, start) << "round " << round;
            near_misses += depth < start + 1.5 * extent && start > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(near_misses, 1000) << "the bound is of use";
}

} // namespace

} // namespace parallel_start
