#include "lib/view/lamp_tree.h"
#include "lib/view/lamp_tree_words.h"
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

pt::View view_of_room(const SpotRoom &room) {
    pt::Scene scene;
    const float specular = room.ball_specular;
    scene.materials = {{glm::vec3(0), glm::vec3(0), glm::vec3(1), 0},
                       {glm::vec3(room.floor_diffuse), glm::vec3(0), glm::vec3(0), 0},
                       {glm::vec3(0), glm::vec3(specular), glm::vec3(0), room.ball_glossiness}};
    for (std::uint32_t i = 0; i < room.lamps; ++i)
        scene.spheres.push_back({{2.0 * i, room.lamp_height, 0}, 0.1, {0, 0, 0}, lamp_material});
    scene.spheres.push_back({{-3, 2, 0}, 1, {0, 0, 0}, polished_material});
    scene.planes = {{{0, 1, 0}, 0, room.floor_material}, {{0, -1, 0}, 10, matt_material}};
    const pt::Camera camera{{0, 2, 8}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.0, 0.0};
    return pt::view_of(pt::PreparedScene(scene), camera,
                       {4, 4, room.max_path_length, 0, 0, room.estimator, PT_SAMPLER_SOBOL, 0, 4});
}

TEST(LightSpots, AreGlowsNearPlanesAndImagesInWhatIsPolished) {
    constexpr double far_from_planes = 5;
    const struct {
        const char *why;
        SpotRoom room;
        std::uint32_t spots;
    } cases[] = {{"close to the floor", {}, 1},
                 {"close to the ceiling", {.lamp_height = 9.5}, 1},
                 {"a fifth of the 8.4 to the ceiling", {.lamp_height = 1.6}, 1},
                 {"more than a fifth of the 8.3 to the ceiling", {.lamp_height = 1.7}, 0},
                 {"the lamp covers it", {.lamp_height = 0.14}, 0},
                 {"too dark", {.floor_diffuse = 0.3F}, 0},
                 {"an image", {.lamp_height = far_from_planes, .ball_specular = 0.5F}, 1},
                 {"a dark image", {.lamp_height = far_from_planes, .ball_specular = 0.4F}, 0},
                 {"a wide image", {.lamp_height = far_from_planes, .ball_specular = 0.5F, .ball_glossiness = 40}, 0},
                 {"images in ball and floor",
                  {.lamp_height = far_from_planes, .ball_specular = 0.5F, .floor_material = polished_material},
                  2},
                 {"a glow and an image for each lamp", {.ball_specular = 0.5F, .lamps = 4}, 8},
                 {"too many", {.ball_specular = 0.5F, .lamps = 5}, 0},
                 {"paths too short", {.max_path_length = 2}, 0},
                 {"lamps are sampled", {.estimator = PT_ESTIMATOR_LIGHT}, 1},
                 {"lamps are not sampled", {.estimator = PT_ESTIMATOR_BSDF}, 0}};
    for (const auto &[why, room, spots] : cases)
        EXPECT_EQ(view_of_room(room).features[pt::gpu::ID_SPOT_COUNT], spots) << why;
}

TEST(LightSpots, AreTheLastWordsOfTheScene) {
    const std::vector<glm::vec4> words = view_of_room({.ball_specular = 0.5F}).words;
    const auto word = [](std::uint32_t lamp, std::uint32_t surface, float reflectance, float glossiness) {
        const auto bits = [](std::uint32_t number) {
            return std::bit_cast<float>(pt::gpu::MATERIAL_INDEX_BITS + number);
        };
        return glm::vec4(bits(lamp), bits(surface), reflectance, glossiness);
    };
    EXPECT_EQ(words[words.size() - 2], word(0, 1, 0.5F, 1000.0F)) << "the ball";
    EXPECT_EQ(words.back(), word(0, 2, 0.5F, -1.0F)) << "the floor";
}

TEST(LampTreeShape, HasASlotForEachLampAndMostAreTaken) {
    for (std::uint32_t count = 1; count < 70000; count += 1 + count / 7) {
        const pt::LampTreeShape shape(count);
        EXPECT_GE(shape.slots(), count);
        if (count > 16) {
            EXPECT_LT(shape.slots(), 2 * std::uint64_t{count}) << count;
        }
        EXPECT_LE(shape.top_groups(), pt::gpu::LAMP_TREE_TOP_GROUPS);
        EXPECT_EQ(shape.top_groups(), pt::gpu::lamp_tree_top_groups(count, shape.levels()));
        EXPECT_EQ(shape.first_lamp(0), 0U);
        EXPECT_EQ(shape.first_lamp(shape.slots()), count);
        std::uint64_t groups = 0;
        for (std::uint32_t level = 0; level <= shape.levels(); ++level) {
            EXPECT_EQ(shape.groups_above(level), groups);
            groups += shape.groups_of(level);
        }
        EXPECT_EQ(shape.all_groups(), groups);
        EXPECT_EQ(pt::gpu::lamp_tree_groups(count, shape.levels()), groups);
        for (std::uint64_t slot = 0; slot < shape.slots(); ++slot)
            ASSERT_LE(shape.first_lamp(slot + 1) - shape.first_lamp(slot), 1U) << "one lamp to a slot";
        for (std::uint64_t node = 0; node < shape.slots(); node += 4)
            if (count >= 16) {
                ASSERT_GT(shape.first_lamp(node + 4), shape.first_lamp(node)) << "no group of slots is empty";
            }
    }
}

TEST(LampTreeFeature, IsForManyLampsThatAreSampled) {
    const auto levels = [](const SpotRoom &room) { return view_of_room(room).features[pt::gpu::ID_LAMP_TREE_LEVELS]; };
    EXPECT_EQ(levels({.lamps = pt::least_tree_lamps - 1}), 0U);
    EXPECT_EQ(levels({.lamps = pt::least_tree_lamps}), 1U);
    EXPECT_EQ(levels({.lamps = pt::least_tree_lamps, .estimator = PT_ESTIMATOR_LIGHT}), 1U);
    EXPECT_EQ(levels({.lamps = pt::least_tree_lamps, .estimator = PT_ESTIMATOR_BSDF}), 0U);
}

} // namespace
