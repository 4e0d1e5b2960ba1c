#include "lib/view/light_spots.h"
#include "lib/view/view.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <bit>
#include <cstdint>
#include <vector>

namespace {

constexpr std::uint32_t lamp_material = 0;
constexpr std::uint32_t matt_material = 1;
constexpr std::uint32_t polished_material = 2;

struct SpotRoom {
    double lamp_height = 0.5;
    float floor_diffuse = 0.5F;
    float ball_specular = 0.0F;
    float ball_glossiness = 1000.0F;
    std::uint32_t lamps = 1;
    std::uint32_t floor_material = matt_material;
    std::uint32_t max_path_length = 3;
    std::uint32_t estimator = PT_ESTIMATOR_MIS;
};

pt::View scene_of_room(const SpotRoom &room, const glm::dvec3 &eye = {0, 2, 8}) {
    pt::Scene scene;
    const float specular = room.ball_specular;
    scene.materials = {{glm::vec3(0), glm::vec3(0), glm::vec3(1), 0},
                       {glm::vec3(room.floor_diffuse), glm::vec3(0), glm::vec3(0), 0},
                       {glm::vec3(0), glm::vec3(specular), glm::vec3(0), room.ball_glossiness}};
    for (std::uint32_t i = 0; i < room.lamps; ++i)
        scene.spheres.push_back({{2.0 * i, room.lamp_height, 0}, 0.1, {0, 0, 0}, lamp_material});
    scene.spheres.push_back({{-3, 2, 0}, 1, {0, 0, 0}, polished_material});
    scene.planes = {{{0, 1, 0}, 0, room.floor_material}, {{0, -1, 0}, 10, matt_material}};
    const pt::Camera camera{eye, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.0, 0.0};
    return pt::view_of(pt::PreparedScene(scene), camera,
                       {4, 4, room.max_path_length, 0, 0, room.estimator, PT_SAMPLER_SOBOL, 0, 4});
}

std::uint32_t spots_of(const SpotRoom &room) {
    const pt::View scene = scene_of_room(room);
    return scene.features[pt::gpu::ID_SPOT_COUNT];
}

TEST(LightSpots, AreGlowsWhereALampIsCloseToAPlane) {
    EXPECT_EQ(spots_of({}), 1U);
    EXPECT_EQ(spots_of({.lamp_height = 9.5}), 1U) << "the ceiling";
    EXPECT_EQ(spots_of({.lamp_height = 1.6}), 1U);
    EXPECT_EQ(spots_of({.lamp_height = 1.7}), 0U) << "more than a fifth of the 8.3 to the ceiling";
    EXPECT_EQ(spots_of({.lamp_height = 5}), 0U);
    EXPECT_EQ(spots_of({.lamp_height = 0.14}), 0U) << "the lamp covers it";
    EXPECT_EQ(spots_of({.floor_diffuse = 0.3F}), 0U) << "too dark";
}

TEST(LightSpots, AreImagesInWhatIsPolished) {
    constexpr double far_from_planes = 5;
    EXPECT_EQ(spots_of({.lamp_height = far_from_planes, .ball_specular = 0.5F}), 1U);
    EXPECT_EQ(spots_of({.lamp_height = far_from_planes, .ball_specular = 0.4F}), 0U);
    EXPECT_EQ(spots_of({.lamp_height = far_from_planes, .ball_specular = 0.5F, .ball_glossiness = 40}), 0U);
    EXPECT_EQ(spots_of({.lamp_height = far_from_planes, .ball_specular = 0.5F, .floor_material = polished_material}),
              2U);
}

TEST(LightSpots, AreForPathsOfThreeVerticesThatSampleLamps) {
    EXPECT_EQ(spots_of({.max_path_length = 2}), 0U);
    EXPECT_EQ(spots_of({.estimator = PT_ESTIMATOR_LIGHT}), 1U);
    EXPECT_EQ(spots_of({.estimator = PT_ESTIMATOR_BSDF}), 0U);
}

TEST(LightSpots, AreNoneWhereTheyWouldBeMany) {
    SpotRoom room{.ball_specular = 0.5F, .lamps = 4};
    EXPECT_EQ(spots_of(room), 8U) << "a glow and an image for each lamp";
    room.floor_material = polished_material;
    room.lamp_height = 0.5;
    EXPECT_EQ(spots_of(room), 8U) << "two images";
    room.lamps = 5;
    EXPECT_EQ(spots_of(room), 0U);
}

TEST(LightSpots, AreTheLastWordsOfTheScene) {
    const SpotRoom room{.ball_specular = 0.5F};
    const pt::View scene = scene_of_room(room);
    ASSERT_EQ(scene.features[pt::gpu::ID_SPOT_COUNT], 2U);
    const auto number = [](float bits) { return std::bit_cast<std::uint32_t>(bits) - pt::gpu::MATERIAL_INDEX_BITS; };
    const glm::vec4 image = scene.words[scene.words.size() - 2];
    const glm::vec4 glow = scene.words.back();
    EXPECT_EQ(number(image.x), 0U);
    EXPECT_EQ(number(image.y), 1U) << "the ball";
    EXPECT_EQ(image.z, 0.5F);
    EXPECT_EQ(image.w, 1000.0F);
    EXPECT_EQ(number(glow.x), 0U);
    EXPECT_EQ(number(glow.y), 2U) << "the floor";
    EXPECT_EQ(glow.z, 0.5F);
    EXPECT_EQ(glow.w, -1.0F);
    const pt::View elsewhere = scene_of_room(room, {100, 3, -50});
    EXPECT_EQ(elsewhere.features, scene.features);
    EXPECT_EQ(elsewhere.words.back(), glow);
}

} // namespace
