#include "lib/view/scene_features.h"
#include "lib/view/view.h"
#include "tests/support/checked_scene_of.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace {

constexpr std::uint32_t dark = 0;
constexpr std::uint32_t shining = 1;
constexpr std::uint32_t negative_zero = 2;

const glm::dvec3 eye = {1, 2, 3};
const glm::dvec3 nowhere = {0, 0, 0};

struct Shutter {
    double open = 0;
    double close = 1;
};

struct FeatureCase {
    const char *why;
    std::vector<pt::Sphere> spheres;
    std::vector<pt::Plane> planes = {};
    Shutter shutter = {};
};

pt::Features features_of(const FeatureCase &of) {
    pt::Scene scene;
    scene.materials = {{glm::vec3(0.5F), glm::vec3(0), glm::vec3(0), 0},
                       {glm::vec3(0), glm::vec3(0), glm::vec3(1), 0},
                       {glm::vec3(0.5F), glm::vec3(0), glm::vec3(-0.0F), 0}};
    scene.spheres = of.spheres;
    scene.planes = of.planes;
    const pt::Camera camera{eye, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, of.shutter.open, of.shutter.close};
    return pt::view_of(pt::PreparedScene(scene), camera, {4, 4, 2, 0, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_RANDOM, 0, 4})
        .features;
}

void expect_feature(std::uint32_t id, std::uint32_t expected, std::initializer_list<FeatureCase> cases) {
    for (const FeatureCase &each : cases)
        EXPECT_EQ(features_of(each)[id], expected) << each.why;
}

pt::Sphere ball_at(const glm::dvec3 &center, double radius, const glm::dvec3 &motion = nowhere,
                   std::uint32_t material = dark) {
    return {eye + center, radius, motion, material};
}

pt::Sphere lamp_at(const glm::dvec3 &center, double radius, const glm::dvec3 &motion = nowhere) {
    return ball_at(center, radius, motion, shining);
}

pt::Plane floor_at(double height, bool upwards = true, std::uint32_t material = dark) {
    const double side = upwards ? 1 : -1;
    return {{0, side, 0}, -side * (eye.y + height), material};
}

const pt::Sphere huge_ball = ball_at({0, -1e6 - 1, 0}, 1e6);

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
    }
}

TEST(FeatureInside, IsWhetherTheCameraIsInASphereAtAnyTimeOfTheShutter) {
    const auto passing = [](double height) { return ball_at({-8, height, 0}, 1, {16, 0, 0}); };
    expect_feature(pt::gpu::ID_INSIDE, 1,
                   {{"in it", {ball_at({0, 3, -4}, 6)}},
                    {"in a lamp", {lamp_at({0, 3, -4}, 6)}},
                    {"in its center", {ball_at({0, 0, 0}, 1e-3)}},
                    {"in the second alone", {ball_at({0, 0, -5}, 4), ball_at({0, 5, 0}, 6)}},
                    {"in the first alone", {ball_at({0, 0, -5}, 6), ball_at({0, 5, 0}, 4)}},
                    {"in mid-shutter alone", {passing(0.75)}},
                    {"as it closes", {passing(0)}, {}, {0, 0.5}},
                    {"as it opens", {passing(0)}, {}, {0.5, 1}},
                    {"a moment", {passing(0)}, {}, {0.5, 0.5}}});
    expect_feature(pt::gpu::ID_INSIDE, 0,
                   {{"nothing is there", {}},
                    {"beside a ball", {ball_at({0, 3, -4}, 4)}},
                    {"beside a lamp", {lamp_at({0, 3, -4}, 4)}},
                    {"it passes by", {passing(1.25)}},
                    {"not yet", {passing(0)}, {}, {0, 0.375}},
                    {"no more", {passing(0)}, {}, {0.625, 1}}});
}

TEST(FeatureInside, IsTrueWhereFloat32CannotTell) {
    for (const auto &[share, expected] : {std::pair{1 - 0x1p-20, 1U}, {1.0, 1U}, {1 + 0x1p-20, 1U}, {1 + 0x1p-10, 0U}})
        expect_feature(pt::gpu::ID_INSIDE, expected, {{"it touches", {ball_at({-8, 2 * share, 0}, 2, {16, 0, 0})}}});
    for (const double distance : {1 - 0x1p-20, 1.0, 1 + 0x1p-20})
        for (const std::uint32_t material : {dark, shining}) {
            const pt::Features resting = features_of({"", {ball_at({0, distance, 0}, 1, nowhere, material)}});
            EXPECT_TRUE(resting[pt::gpu::ID_CURVATURE]);
            EXPECT_EQ(resting[pt::gpu::ID_SPHERE_COUNT], 0U);
            EXPECT_FALSE(resting[pt::gpu::ID_INSIDE]);
        }
}

TEST(FeaturePlanesEmit, IsWhetherAnythingButALampEmits) {
    const pt::Sphere lamp = lamp_at({0, 3, -5}, 1);
    const pt::Sphere huge_lamp = lamp_at({0, 0, -262145}, 262144);
    expect_feature(pt::gpu::ID_PLANES_EMIT, 0,
                   {{"nothing is there", {}}, {"a lamp", {lamp}, {floor_at(-4)}}, {"a huge ball", {huge_ball}}});
    expect_feature(pt::gpu::ID_PLANES_EMIT, 1,
                   {{"a plane", {}, {floor_at(-5, true, shining)}},
                    {"the last plane", {lamp}, {floor_at(-4), floor_at(-5, true, shining)}},
                    {"a huge lamp", {huge_lamp}}});
}

TEST(FeaturePlanesBlock, IsWhetherALampIsNotAllOnTheSideOfTheCamera) {
    const auto lamp = [](double height) { return lamp_at({0, height, -5}, 1); };
    for (const bool upwards : {true, false}) {
        const pt::Plane floor = floor_at(-4, upwards);
        const pt::Plane ceiling = floor_at(4, upwards);
        const pt::Plane at_camera = floor_at(0, upwards);
        expect_feature(pt::gpu::ID_PLANES_BLOCK, 0,
                       {{"just above a floor", {lamp(-2.875)}, {floor}}, {"below a ceiling", {lamp(1)}, {ceiling}}});
        expect_feature(pt::gpu::ID_PLANES_BLOCK, 1,
                       {{"touches it", {lamp(-3)}, {floor}},
                        {"mostly below", {lamp(-4.5)}, {floor}},
                        {"below", {lamp(-9)}, {floor}},
                        {"above a ceiling", {lamp(9)}, {ceiling}},
                        {"the camera is on the plane", {lamp(3)}, {at_camera}}});
    }
}

TEST(FeaturePlanesBlock, IsByAnyPlaneAndAnyLampAtAnyTime) {
    const pt::Plane tilted = {{0.6, 0, 0.8}, 7 - glm::dot(glm::dvec3(0.6, 0, 0.8), eye), dark};
    const std::vector<pt::Plane> three = {floor_at(-4), floor_at(4), tilted};
    const pt::Sphere near = lamp_at({0, 1, -5}, 1);
    const pt::Sphere falling = lamp_at({0, 3, -5}, 1, {0, -12, 0});
    expect_feature(pt::gpu::ID_PLANES_BLOCK, 0,
                   {{"between all", {near}, three},
                    {"no planes", {lamp_at({0, -9, -5}, 1)}},
                    {"no lamp", {ball_at({0, -9, -5}, 1)}, {floor_at(-4)}},
                    {"emits -0", {ball_at({0, -9, -5}, 1, nowhere, negative_zero)}, {floor_at(-4)}},
                    {"not yet", {falling}, {floor_at(-4)}, {0, 0.4375}},
                    {"along the floor", {lamp_at({0, 3, -5}, 1, {9, 0, 9})}, {floor_at(-4)}},
                    {"a ball held by its center", {ball_at({0, -14, 0}, 10), near}}});
    expect_feature(pt::gpu::ID_PLANES_BLOCK, 1,
                   {{"the last lamp, the last plane", {near, lamp_at({-6, 1, -8}, 1)}, three},
                    {"the first lamp", {lamp_at({0, 6, -5}, 1), near}, three},
                    {"partly through as the shutter closes", {falling}, {floor_at(-4)}, {0, 0.5625}},
                    {"a moment", {falling}, {floor_at(-4)}, {1, 1}},
                    {"a curved plane may bulge", {huge_ball, near}}});
}

TEST(FeatureSky, IsALampThatHoldsTheCamera) {
    const auto counts = [](const std::vector<pt::Sphere> &spheres, const Shutter &shutter = {}) {
        const pt::Features features = features_of({"", spheres, {}, shutter});
        return std::pair{features[pt::gpu::ID_LAMP_COUNT], features[pt::gpu::ID_SKY_COUNT]};
    };
    using Counts = std::pair<std::uint32_t, std::uint32_t>;
    EXPECT_EQ(counts({lamp_at({0, 3, 0}, 2)}), (Counts{1, 0}));
    EXPECT_EQ(counts({lamp_at({0, 3, 0}, 4), ball_at({0, 3, 0}, 4), lamp_at({0, 3, 0}, 1)}), (Counts{1, 1}));
    EXPECT_EQ(counts({lamp_at({0, 3, 0}, 4, {0, 2, 0})}), (Counts{1, 0})) << "not all of the time";
    EXPECT_EQ(counts({lamp_at({0, 3, 0}, 4, {0, 2, 0})}, {0, 0.4}), (Counts{0, 1}));
}

TEST(FeatureKnownSides, IsWhetherTheCameraTellsThemAndMust) {
    const pt::Sphere room = ball_at({0, 0, 0}, 9);
    expect_feature(pt::gpu::ID_KNOWN_SIDES, 1,
                   {{"close planes", {}, {floor_at(-1), floor_at(-1.001)}},
                    {"inside", {room}, {floor_at(-1)}},
                    {"a huge ball", {huge_ball}, {floor_at(-1)}},
                    {"a plane just below", {room}, {floor_at(-1e-15)}}});
    expect_feature(pt::gpu::ID_KNOWN_SIDES, 0,
                   {{"vertices do as well", {}, {floor_at(-1), floor_at(-2)}},
                    {"the camera is on the plane", {room}, {floor_at(0)}},
                    {"the camera is on the huge ball", {ball_at({0, -1e6, 0}, 1e6)}, {floor_at(-1)}}});
}

TEST(FeatureCurvature, IsWhetherASphereIsNearlyFlat) {
    expect_feature(pt::gpu::ID_CURVATURE, 0,
                   {{"ball", {ball_at({0, -32, 0}, 31)}}, {"lamp", {lamp_at({0, -65536, 0}, 65535)}}});
    expect_feature(pt::gpu::ID_CURVATURE, 1,
                   {{"ball", {ball_at({0, -34, 0}, 33)}}, {"lamp", {lamp_at({0, -65538, 0}, 65537)}}});
}

TEST(FeatureMotion, IsWhetherAHugeBallMovesWhileTheShutterIsOpen) {
    const pt::Sphere moving = ball_at({0, -1e6 - 1, 0}, 1e6, {1e-9, 0, 0});
    expect_feature(pt::gpu::ID_MOTION, 0, {{"at rest", {huge_ball}}, {"a moment", {moving}, {}, {0.5, 0.5}}});
    expect_feature(pt::gpu::ID_MOTION, 1, {{"a little", {moving}}});
}

// The lamp's light at the ball is 100 / 25. A sky of 2 has half of it.
TEST(BranchCount, IsOneWhereALampOutshinesTheSkyTwice) {
    for (const float sky : {0.0F, 1.9F, 2.1F}) {
        pt::Scene scene;
        scene.materials = {{glm::vec3(0.5F), glm::vec3(0), glm::vec3(0), 0},
                           {glm::vec3(0), glm::vec3(0), glm::vec3(100), 0},
                           {glm::vec3(0), glm::vec3(0), glm::vec3(sky), 0}};
        scene.spheres = {ball_at(nowhere, 1), lamp_at({0, 50, 0}, 10), ball_at(nowhere, 1000, nowhere, 2)};
        const pt::Camera camera{eye + glm::dvec3(0, 0, 9), {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0, 1};
        const pt::RenderSettings settings{4, 4, 3, 0, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_RANDOM, 0, 4};
        const pt::View view = pt::view_of(pt::PreparedScene(scene), camera, settings);
        EXPECT_EQ(pt::branch_count(view.features), sky == 1.9F ? 1U : 2U) << sky;
    }
}

} // namespace
