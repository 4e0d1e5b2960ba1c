#include "lib/view/scene_features.h"
#include "lib/view/view.h"
#include "tests/support/checked_scene_of.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace {

constexpr std::uint32_t dark = 0;
constexpr std::uint32_t shining = 1;

const glm::dvec3 eye = {1, 2, 3};
const glm::dvec3 nowhere = {0, 0, 0};

struct Shutter {
    double open;
    double close;
};

pt::Features features_of(const std::vector<pt::Sphere> &spheres, const std::vector<pt::Plane> &planes = {},
                         const Shutter &shutter = {0, 1}) {
    pt::Scene scene;
    scene.materials = {{glm::vec3(0.5F), glm::vec3(0), glm::vec3(0), 0},
                       {glm::vec3(0), glm::vec3(0), glm::vec3(1), 0},
                       {glm::vec3(0.5F), glm::vec3(0), glm::vec3(-0.0F), 0}};
    scene.spheres = spheres;
    scene.planes = planes;
    const pt::Camera camera{eye, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, shutter.open, shutter.close};
    return pt::view_of(pt::PreparedScene(scene), camera, {4, 4, 2, 0, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_RANDOM, 0, 4})
        .features;
}

pt::Sphere ball_at(const glm::dvec3 &center, double radius, const glm::dvec3 &motion = nowhere,
                   std::uint32_t material = dark) {
    return {eye + center, radius, motion, material};
}

pt::Sphere lamp_at(const glm::dvec3 &center, double radius, const glm::dvec3 &motion = nowhere) {
    return ball_at(center, radius, motion, shining);
}

bool inside(const std::vector<pt::Sphere> &spheres, const Shutter &shutter = {0, 1}) {
    return features_of(spheres, {}, shutter)[pt::gpu::ID_INSIDE];
}

TEST(FeatureTreeInside, IsWhetherTheCameraIsInASphereOfTheTree) {
    pt::Scene scene;
    scene.materials = {{glm::vec3(0.5F), glm::vec3(0), glm::vec3(0), 0}, {glm::vec3(0), glm::vec3(0), glm::vec3(1), 0}};
    std::vector<pt_sphere> spheres;
    for (int i = 0; i < 100; ++i)
        spheres.push_back({{3.0 * (i % 10), 3.0 * (i / 10.0), -9}, 1, {0, 0, 0}, dark, 0});
    spheres.push_back({{0, 0, 0}, 1000, {0, 0, 0}, shining, 0});
    const pt::PreparedScene prepared = prepared_scene_of({scene.materials, {spheres, {}}, {}}, 50);
    ASSERT_TRUE(prepared.tree);
    for (const double z : {0.0, -9.0}) {
        const pt::Camera camera{{0, 0, z}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0, 1};
        const pt::Features features =
            pt::view_of(prepared, camera, {4, 4, 2, 0, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_RANDOM, 0, 4}).features;
        EXPECT_TRUE(features[pt::gpu::ID_INSIDE]);
        EXPECT_EQ(features[pt::gpu::ID_TREE_INSIDE], z == -9.0 ? 1U : 0U);
        EXPECT_GE(features[pt::gpu::ID_TREE_LEVELS], prepared.tree->depth());
        EXPECT_LT(features[pt::gpu::ID_TREE_LEVELS], prepared.tree->depth() + 4);
    }
}

TEST(FeatureInside, IsWhetherTheCameraIsInASphere) {
    EXPECT_FALSE(inside({}));
    for (const std::uint32_t material : {dark, shining}) {
        EXPECT_FALSE(inside({ball_at({0, 3, -4}, 4, nowhere, material)}));
        EXPECT_TRUE(inside({ball_at({0, 3, -4}, 6, nowhere, material)}));
        EXPECT_TRUE(inside({ball_at({0, 0, 0}, 1e-3, nowhere, material)})) << "in its center";
    }
    EXPECT_FALSE(inside({ball_at({0, 0, -5}, 4), ball_at({0, 5, 0}, 4)}));
    EXPECT_TRUE(inside({ball_at({0, 0, -5}, 4), ball_at({0, 5, 0}, 6)})) << "in the second alone";
    EXPECT_TRUE(inside({ball_at({0, 0, -5}, 6), ball_at({0, 5, 0}, 4)})) << "in the first alone";
}

TEST(FeatureInside, IsTrueWhereFloat32CannotTell) {
    constexpr double radius = 2;
    const auto touches = [](double distance) { return inside({ball_at({-8, distance, 0}, radius, {16, 0, 0})}); };
    EXPECT_TRUE(touches(radius * (1 - 0x1p-20)));
    EXPECT_TRUE(touches(radius));
    EXPECT_TRUE(touches(radius * (1 + 0x1p-20)));
    EXPECT_FALSE(touches(radius * (1 + 0x1p-10)));
    for (const double distance : {1 - 0x1p-20, 1.0, 1 + 0x1p-20})
        for (const std::uint32_t material : {dark, shining}) {
            const pt::Features resting = features_of({ball_at({0, distance, 0}, 1, nowhere, material)});
            EXPECT_TRUE(resting[pt::gpu::ID_CURVATURE]);
            EXPECT_EQ(resting[pt::gpu::ID_SPHERE_COUNT], 0U);
            EXPECT_FALSE(resting[pt::gpu::ID_INSIDE]);
        }
}

TEST(FeatureInside, IsAtAnyTimeOfTheShutter) {
    const auto passing = [](double height, const Shutter &shutter) {
        return inside({ball_at({-8, height, 0}, 1, {16, 0, 0})}, shutter);
    };
    EXPECT_TRUE(passing(0, {0, 1})) << "in mid-shutter alone";
    EXPECT_TRUE(passing(0.75, {0, 1}));
    EXPECT_FALSE(passing(1.25, {0, 1}));
    EXPECT_TRUE(passing(0, {0, 0.5})) << "as it closes";
    EXPECT_TRUE(passing(0, {0.5, 1})) << "as it opens";
    EXPECT_FALSE(passing(0, {0, 0.375})) << "not yet";
    EXPECT_FALSE(passing(0, {0.625, 1})) << "no more";
    EXPECT_FALSE(passing(0, {0, 0}));
    EXPECT_TRUE(passing(0, {0.5, 0.5}));
    EXPECT_FALSE(features_of({ball_at({-8, 0, 0}, 1, {16, 0, 0})}, {}, {0.5, 0.5})[pt::gpu::ID_MOTION]);
}

pt::Plane floor_at(double height, bool upwards = true) {
    const double side = upwards ? 1 : -1;
    return {{0, side, 0}, -side * (eye.y + height), dark};
}

TEST(FeaturePlanesEmit, IsWhetherAnythingButALampEmits) {
    pt::Plane glowing = floor_at(-5);
    glowing.material = shining;
    const pt::Sphere huge_lamp = lamp_at({0, 0, -262145}, 262144);
    EXPECT_FALSE(features_of({})[pt::gpu::ID_PLANES_EMIT]);
    EXPECT_FALSE(features_of({lamp_at({0, 3, -5}, 1)}, {floor_at(-4)})[pt::gpu::ID_PLANES_EMIT]);
    EXPECT_FALSE(features_of({ball_at({0, 0, -262145}, 262144)}, {floor_at(-4)})[pt::gpu::ID_PLANES_EMIT]);
    EXPECT_TRUE(features_of({}, {glowing})[pt::gpu::ID_PLANES_EMIT]);
    EXPECT_TRUE(features_of({lamp_at({0, 3, -5}, 1)}, {floor_at(-4), glowing})[pt::gpu::ID_PLANES_EMIT])
        << "the last plane";
    EXPECT_TRUE(features_of({huge_lamp})[pt::gpu::ID_CURVATURE]);
    EXPECT_TRUE(features_of({huge_lamp})[pt::gpu::ID_PLANES_EMIT]);
}

bool planes_block(const std::vector<pt::Sphere> &spheres, const std::vector<pt::Plane> &planes,
                  const Shutter &shutter = {0, 1}) {
    return features_of(spheres, planes, shutter)[pt::gpu::ID_PLANES_BLOCK];
}

TEST(FeaturePlanesBlock, IsWhetherALampIsNotAllOnTheSideOfTheCamera) {
    for (const bool upwards : {true, false}) {
        const std::vector<pt::Plane> floor = {floor_at(-4, upwards)};
        EXPECT_FALSE(planes_block({lamp_at({0, 3, -5}, 1)}, floor)) << "above";
        EXPECT_FALSE(planes_block({lamp_at({0, -2.875, -5}, 1)}, floor)) << "just above";
        EXPECT_TRUE(planes_block({lamp_at({0, -3, -5}, 1)}, floor)) << "touches it";
        EXPECT_TRUE(planes_block({lamp_at({0, -3.5, -5}, 1)}, floor)) << "mostly above";
        EXPECT_TRUE(planes_block({lamp_at({0, -4.5, -5}, 1)}, floor)) << "mostly below";
        EXPECT_TRUE(planes_block({lamp_at({0, -5, -5}, 1)}, floor)) << "touches it from below";
        EXPECT_TRUE(planes_block({lamp_at({0, -9, -5}, 1)}, floor)) << "below";
        EXPECT_TRUE(planes_block({lamp_at({0, 9, -5}, 1)}, {floor_at(4, upwards)})) << "above a ceiling";
        EXPECT_FALSE(planes_block({lamp_at({0, 1, -5}, 1)}, {floor_at(4, upwards)})) << "below a ceiling";
        EXPECT_TRUE(planes_block({lamp_at({0, 3, -5}, 1)}, {floor_at(0, upwards)})) << "the camera is on the plane";
        EXPECT_TRUE(planes_block({lamp_at({0, -3, -5}, 1)}, {floor_at(0, upwards)})) << "the camera is on the plane";
    }
}

TEST(FeaturePlanesBlock, IsByAnyPlaneAndAnyLamp) {
    const pt::Plane tilted = {{0.6, 0, 0.8}, 7 - glm::dot(glm::dvec3(0.6, 0, 0.8), eye), dark};
    const pt::Sphere near = lamp_at({0, 1, -5}, 1);
    const pt::Sphere far = lamp_at({-6, 1, -8}, 1);
    const pt::Sphere across = lamp_at({-4.2, 1, -5.6}, 1);
    const pt::Sphere high = lamp_at({0, 6, -5}, 1);
    EXPECT_FALSE(planes_block({near}, {tilted, floor_at(-4), floor_at(4)}));
    EXPECT_TRUE(planes_block({far}, {tilted, floor_at(-4), floor_at(4)}));
    EXPECT_TRUE(planes_block({across}, {tilted, floor_at(-4), floor_at(4)}));
    EXPECT_TRUE(planes_block({near, far}, {floor_at(-4), floor_at(4), tilted})) << "the last lamp, the last plane";
    EXPECT_TRUE(planes_block({high, near}, {floor_at(-4), floor_at(4), tilted}));
    EXPECT_FALSE(planes_block({high, near}, {floor_at(-4), tilted}));
}

TEST(FeaturePlanesBlock, IsAtAnyTimeOfTheShutter) {
    const auto falling = [](const Shutter &shutter) {
        return planes_block({lamp_at({0, 3, -5}, 1, {0, -12, 0})}, {floor_at(-4)}, shutter);
    };
    EXPECT_TRUE(falling({0, 1}));
    EXPECT_TRUE(falling({0, 0.5625})) << "partly through as the shutter closes";
    EXPECT_FALSE(falling({0, 0.4375})) << "not yet";
    EXPECT_FALSE(falling({0, 0}));
    EXPECT_FALSE(falling({0.25, 0.25}));
    EXPECT_TRUE(falling({1, 1}));
    EXPECT_FALSE(planes_block({lamp_at({0, 3, -5}, 1, {9, 0, 9})}, {floor_at(-4)})) << "along the floor";
    EXPECT_TRUE(planes_block({lamp_at({0, -9, -5}, 1, {0, 12, 0})}, {floor_at(-4)})) << "comes up from below";
}

TEST(FeaturePlanesBlock, NeedsPlanesAndLamps) {
    EXPECT_FALSE(planes_block({lamp_at({0, -9, -5}, 1)}, {}));
    EXPECT_FALSE(planes_block({ball_at({0, -9, -5}, 1)}, {floor_at(-4)})) << "no lamp";
    EXPECT_FALSE(planes_block({ball_at({0, -9, -5}, 1, nowhere, 2)}, {floor_at(-4)})) << "emits -0";
    EXPECT_FALSE(planes_block({}, {floor_at(-4)}));
    EXPECT_FALSE(planes_block({}, {}));
}

// A curved plane may bulge between two points on one side of its tangent plane.
TEST(FeaturePlanesBlock, IsTrueWithACurvedPlane) {
    const pt::Sphere huge = ball_at({0, -1004, 0}, 1000);
    const pt::Features features = features_of({huge, lamp_at({0, 3, -5}, 1)}, {});
    EXPECT_TRUE(features[pt::gpu::ID_CURVATURE]);
    EXPECT_TRUE(features[pt::gpu::ID_PLANES_BLOCK]);
    EXPECT_FALSE(planes_block({ball_at({0, -14, 0}, 10), lamp_at({0, 3, -5}, 1)}, {})) << "held by its center";
}

TEST(FeatureSky, IsALampThatHoldsTheCamera) {
    const auto counts = [](const std::vector<pt::Sphere> &spheres, const Shutter &shutter = {0, 1}) {
        const pt::Features features = features_of(spheres, {}, shutter);
        return std::pair{features[pt::gpu::ID_LAMP_COUNT], features[pt::gpu::ID_SKY_COUNT]};
    };
    using Counts = std::pair<std::uint32_t, std::uint32_t>;
    EXPECT_EQ(counts({lamp_at({0, 3, 0}, 2)}), (Counts{1, 0}));
    EXPECT_EQ(counts({lamp_at({0, 3, 0}, 4)}), (Counts{0, 1}));
    EXPECT_EQ(counts({lamp_at({0, 3, 0}, 4), ball_at({0, 3, 0}, 4), lamp_at({0, 3, 0}, 1)}), (Counts{1, 1}));
    EXPECT_EQ(counts({lamp_at({0, 3, 0}, 4, {0, 2, 0})}), (Counts{1, 0})) << "not all of the time";
    EXPECT_EQ(counts({lamp_at({0, 3, 0}, 4, {0, 2, 0})}, {0, 0.4}), (Counts{0, 1}));
}

// `heights` are the depths of floors below the camera.
bool known_sides(const std::vector<pt::Sphere> &spheres, const std::vector<double> &heights) {
    std::vector<pt::Plane> planes;
    for (const double height : heights)
        planes.push_back({{0, 1, 0}, height - eye.y, dark});
    return features_of(spheres, planes)[pt::gpu::ID_KNOWN_SIDES];
}

TEST(FeatureKnownSides, IsWhetherTheCameraTellsThemAndMust) {
    const pt::Sphere room = ball_at({0, 0, 0}, 9);
    EXPECT_FALSE(known_sides({}, {1, 2})) << "vertices do as well";
    EXPECT_TRUE(known_sides({}, {1, 1.001})) << "close planes";
    EXPECT_TRUE(known_sides({room}, {1})) << "inside";
    EXPECT_TRUE(known_sides({ball_at({0, -1e6 - 1, 0}, 1e6)}, {1})) << "a huge ball";
    EXPECT_TRUE(known_sides({room}, {1e-15}));
    EXPECT_FALSE(known_sides({room}, {0})) << "the camera is on the plane";
    EXPECT_FALSE(known_sides({ball_at({0, -1e6, 0}, 1e6)}, {1})) << "the camera is on the huge ball";
}

TEST(FeatureMotion, IsWhetherAHugeBallMoves) {
    const auto moves = [](const glm::dvec3 &motion) {
        const pt::Features features = features_of({ball_at({0, -1e6 - 1, 0}, 1e6, motion)});
        EXPECT_TRUE(features[pt::gpu::ID_CURVATURE]);
        return features[pt::gpu::ID_MOTION];
    };
    EXPECT_FALSE(moves(nowhere));
    EXPECT_TRUE(moves({1e-9, 0, 0}));
}

// Eight small balls about a middle, a lamp of radius 10 at distance 50, and a sky. The lamp's light in the middle is a
// 25th of its radiance, 100.
struct OpenScene {
    float sky = 1.9F;
    float specular = 0.0F;
    std::vector<pt::Plane> planes = {};
    std::uint32_t estimator = PT_ESTIMATOR_MIS;
    double ball_radius = 0.25;
};

std::uint32_t branches_in(const OpenScene &open, bool with_tree) {
    const glm::dvec3 middle = {7, 2, -40};
    std::vector<pt_sphere> spheres = {{{middle.x, middle.y + 50, middle.z}, 10, {0, 0, 0}, shining, 0},
                                      {{0, 0, 0}, 1000, {0, 0, 0}, 2, 0}};
    for (int i = 0; i < 8 && open.ball_radius > 0.0; ++i) {
        const glm::dvec3 corner = middle + 2.0 * glm::dvec3(i % 2, i / 2 % 2, i / 4) - 1.0;
        spheres.push_back({{corner.x, corner.y, corner.z}, open.ball_radius, {0, 0, 0}, dark, 0});
    }
    const std::vector<pt::Material> materials = {{glm::vec3(0.5F), glm::vec3(open.specular), glm::vec3(0), 9},
                                                 {glm::vec3(0), glm::vec3(0), glm::vec3(100), 0},
                                                 {glm::vec3(0), glm::vec3(0), glm::vec3(open.sky), 0}};
    const pt::PreparedScene prepared =
        prepared_scene_of({materials, {spheres, {}}, open.planes}, with_tree ? 1 : UINT32_MAX);
    EXPECT_EQ(prepared.tree != nullptr, with_tree);
    const pt::Camera camera{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0, 1};
    const pt::View view = pt::view_of(prepared, camera, {4, 4, 3, 0, 0, open.estimator, PT_SAMPLER_RANDOM, 0, 4});
    EXPECT_EQ(view.features[pt::gpu::ID_SKY_COUNT], open.sky > 0.0F ? 1U : 0U);
    EXPECT_EQ(view.features.walked_lamps(), 1U);
    return pt::branch_count(view.features);
}

TEST(BranchCount, IsOneIfALampOutshinesTheSkyAndNothingIsGlossy) {
    const pt::Plane floor = {{0, 1, 0}, 9, dark};
    const pt::Plane wall = {{0, 0, 1}, 900, dark};
    for (const bool with_tree : {false, true}) {
        EXPECT_EQ(branches_in({}, with_tree), 1U);
        EXPECT_EQ(branches_in({.planes = {floor}}, with_tree), 1U);
        EXPECT_EQ(branches_in({.estimator = PT_ESTIMATOR_LIGHT}, with_tree), 1U);
        EXPECT_EQ(branches_in({.sky = 2.1F}, with_tree), 2U);
        EXPECT_EQ(branches_in({.sky = 0.0F}, with_tree), 2U) << "no sky";
        EXPECT_EQ(branches_in({.specular = 0.2F}, with_tree), 4U);
        EXPECT_EQ(branches_in({.planes = {floor, wall}}, with_tree), 2U) << "not open";
        EXPECT_EQ(branches_in({.estimator = PT_ESTIMATOR_BSDF}, with_tree), 2U) << "finds the lamp by chance";
    }
    EXPECT_EQ(branches_in({.planes = {floor}, .ball_radius = 0.0}, false), 2U) << "no balls, no middle";
}

} // namespace
