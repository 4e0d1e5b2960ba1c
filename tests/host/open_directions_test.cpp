// Which scenes light paths leave, and where branches therefore share their last direction.
#include "lib/kernel/open_directions.h"

#include "lib/kernel/gpu_scene.h"
#include "lib/kernel/scene_features.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace {

pt::CurvedPlane plane(const glm::dvec3 &normal, double offset = 1) {
    pt::CurvedPlane plane{};
    plane.normal = normal;
    plane.offset = offset;
    return plane;
}

double share(const std::vector<pt::CurvedPlane> &planes) {
    return pt::open_directions(planes);
}

// Of 512 directions about 40 lie within half their spacing of a great circle, each on either side of it by chance: two
// circles put the share off by sqrt(80 / 4) / 512 = 0.009, three of these at the most.
constexpr double tolerance = 0.03;

TEST(OpenDirections, AreTheShareOfTheSphereBetweenPlanes) {
    EXPECT_EQ(share({}), 1.0);
    const auto floor = plane({0, 1, 0});
    const auto wall = plane({0.6, 0, 0.8});
    EXPECT_NEAR(share({floor}), 0.5, tolerance);
    EXPECT_NEAR(share({floor, floor}), 0.5, tolerance);
    EXPECT_NEAR(share({floor, wall}), 0.25, tolerance);
    EXPECT_NEAR(share({floor, wall, plane({0.8, 0, -0.6})}), 0.125, tolerance);
    EXPECT_EQ(share({floor, plane({0, -1, 0})}), 0.0) << "a ceiling";
    const double angle = 0.3 * std::numbers::pi;
    const auto tilted = plane({std::sin(angle), std::cos(angle), 0});
    EXPECT_NEAR(share({floor, tilted}), 0.35, tolerance) << "a lune of (1 - 0.3) pi of 2 pi";
}

// The camera is on the side of a plane on which paths are.
TEST(OpenDirections, AreThoseOnTheSideOfTheCamera) {
    EXPECT_NEAR(share({plane({0, 1, 0}, -1)}), 0.5, tolerance);
    EXPECT_EQ(share({plane({0, 1, 0}), plane({0, 1, 0}, -1)}), 0.0) << "between the two";
    EXPECT_NEAR(share({plane({0, 1, 0}), plane({0, -1, 0}, -1)}), 0.5, tolerance) << "two floors";
}

constexpr std::uint32_t matt = 0;
constexpr std::uint32_t shining = 1;

struct Wanted {
    std::uint32_t max_path_length = 5;
    std::uint32_t estimator = PT_ESTIMATOR_MIS;
    bool is_faster = true;
};

bool one_last_direction(const std::vector<pt::Sphere> &spheres, const std::vector<pt::Plane> &planes,
                        const Wanted &wanted = {}) {
    pt::Scene scene;
    scene.materials = {{glm::vec3(0.5F), glm::vec3(0), glm::vec3(0), 0}, {glm::vec3(0), glm::vec3(0), glm::vec3(1), 0}};
    scene.spheres = spheres;
    scene.planes = planes;
    const pt::Camera camera{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0, 1};
    const pt::RenderSettings settings{4, 4, wanted.max_path_length, 0, 0, wanted.estimator, PT_SAMPLER_SOBOL, 0, 4};
    const pt::Features features = pt::gpu_scene(pt::PreparedScene(scene), camera, settings, wanted.is_faster).features;
    EXPECT_EQ(pt::specialization_constants(features)[pt::gpu::ID_ONE_LAST_DIRECTION],
              features.one_last_direction ? 1U : 0U);
    return features.one_last_direction;
}

const pt::Sphere lamp = {{0, 1, -5}, 0.5, {0, 0, 0}, shining};
const std::vector<pt::Plane> corridor = {{{0, 1, 0}, 2, matt}, {{0, -1, 0}, 3, matt}};

TEST(OneLastDirection, IsOfLongPathsThatStay) {
    EXPECT_TRUE(one_last_direction({lamp}, corridor));
    EXPECT_TRUE(one_last_direction({lamp}, corridor, {6}));
    EXPECT_TRUE(one_last_direction({lamp}, corridor, {12}));
    EXPECT_FALSE(one_last_direction({lamp}, corridor, {4}));
    EXPECT_FALSE(one_last_direction({lamp}, corridor, {6, PT_ESTIMATOR_MIS, false})) << "the device is slower so";
    EXPECT_FALSE(one_last_direction({lamp}, {corridor[0]}));
    EXPECT_FALSE(one_last_direction({lamp}, {}));
    const pt::Sphere room = {{0, 0, 0}, 9, {0, 0, 0}, matt};
    EXPECT_TRUE(one_last_direction({lamp, room}, {})) << "in a ball";
    EXPECT_FALSE(one_last_direction({lamp, {{0, 0, -30}, 9, {0, 0, 0}, matt}}, {})) << "before it";
}

TEST(OneLastDirection, FindsLampsAlone) {
    EXPECT_FALSE(one_last_direction({}, corridor)) << "no lamp";
    EXPECT_FALSE(one_last_direction({lamp}, {corridor[0], {{0, -1, 0}, 3, shining}})) << "a ceiling that shines";
    EXPECT_FALSE(one_last_direction({lamp, {{0, 0, 0}, 9, {0, 0, 0}, shining}}, corridor)) << "a sky";
    EXPECT_FALSE(one_last_direction({lamp}, corridor, {5, PT_ESTIMATOR_BSDF})) << "lamps are not sampled";
    EXPECT_TRUE(one_last_direction({lamp}, corridor, {5, PT_ESTIMATOR_LIGHT}));
}

TEST(OneLastDirection, LooksAtFewLamps) {
    std::vector<pt::Sphere> lamps;
    for (int i = 0; i < 4; ++i)
        lamps.push_back({{2.0 * i, 1, -5}, 0.5, {0, 0, 0}, shining});
    EXPECT_TRUE(one_last_direction(lamps, corridor));
    lamps.push_back({{-2, 1, -5}, 0.5, {0, 0, 0}, shining});
    EXPECT_FALSE(one_last_direction(lamps, corridor));
}

} // namespace
