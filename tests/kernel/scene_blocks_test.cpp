#include "lib/view/scene_blocks.h"
#include "lib/view/view.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <cmath>
#include <cstdint>

namespace {

pt::View view_of_scene(const pt::Scene &scene) {
    const pt::Camera camera{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.25, 0.75};
    return pt::view_of(pt::PreparedScene(scene), camera, {4, 4, 2, 0, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_RANDOM, 0, 4});
}

// The first ball is a lamp.
pt::Scene row_of_balls(std::uint32_t count, std::uint32_t materials) {
    pt::Scene scene;
    scene.materials.assign(materials, {glm::vec3(0.5F), glm::vec3(0), glm::vec3(0), 0});
    scene.materials.push_back({glm::vec3(0), glm::vec3(0), {30, 60, 90}, 0});
    scene.spheres = {{{0, 5, -9}, 1, {0, 0, 0}, materials}};
    for (std::uint32_t i = 1; i < count; ++i)
        scene.spheres.push_back({{i, 0, -9}, 0.25, {0, 0, 0}, i % materials});
    return scene;
}

// 341 surfaces of three words leave one word of the uniform buffer free.
TEST(SceneBlocks, ShareMaterialsInScenesTooLargeForTheUniformBuffer) {
    const pt::View small = view_of_scene(row_of_balls(341, 1));
    EXPECT_TRUE(small.features.scene_in_uniform());
    EXPECT_EQ(small.features.table_materials, 0U);
    EXPECT_EQ(small.words.size(), 3U * 341) << "neither motion nor gloss";

    const pt::View large = view_of_scene(row_of_balls(342, 1));
    EXPECT_FALSE(large.features.scene_in_uniform());
    EXPECT_EQ(large.features.table_materials, 2U);
    EXPECT_EQ(large.words.size(), 342U + 1 + 86 + 2) << "geometry, the lamp's emission, indices, table";
    EXPECT_EQ(view_of_scene(row_of_balls(342, 100)).words.size(), 342U + 1 + 86 + 101);
}

TEST(SceneBlocks, HoldTheLargestScenes) {
    constexpr std::uint32_t most_surfaces = (1U << 30) - 1;
    pt::Features features{};
    features[pt::gpu::ID_SPHERE_COUNT] = features[pt::gpu::ID_LAMP_COUNT] = features.table_materials = most_surfaces;
    features[pt::gpu::ID_GLOSS] = true;
    features[pt::gpu::ID_MOTION] = true;
    constexpr std::uint64_t indices = 1U << 28;
    EXPECT_EQ(pt::SceneBlocks(features).word_count, std::uint64_t{5} * most_surfaces + indices);
    features[pt::gpu::ID_SPHERE_COUNT] = features[pt::gpu::ID_LAMP_COUNT] = 1;
    features[pt::gpu::ID_PLANE_COUNT] = most_surfaces - 1;
    features[pt::gpu::ID_CURVATURE] = true;
    features[pt::gpu::ID_PLANES_EMIT] = true;
    EXPECT_EQ(pt::SceneBlocks(features).word_count, std::uint64_t{5} * most_surfaces + indices);
    features[pt::gpu::ID_SCENE_SOURCE] = pt::gpu::SCENE_IN_UNIFORM;
    EXPECT_EQ(pt::SceneBlocks(features).word_count, std::uint64_t{5} * most_surfaces);
}

TEST(SceneBlocks, HaveAFilmWhoseUnitFollowsTheBrightestLampInUse) {
    pt::Scene scene = row_of_balls(2, 1);
    EXPECT_EQ(pt::PreparedScene(scene).film_unit, 0.5); // 90 is in [2^6, 2^7).
    scene.materials[1].emission = {1e14F, 0, 0};
    EXPECT_EQ(pt::PreparedScene(scene).film_unit, 0x1p39); // 1e14 is in [2^46, 2^47).
    scene.spheres[0].material = 0;
    EXPECT_EQ(pt::PreparedScene(scene).film_unit, 1.0); // unused materials do not count
}

// The film rejects negative light, even negative zeros.
TEST(SceneBlocks, HaveNoNegativeZerosOfLamps) {
    pt::Scene scene = row_of_balls(2, 1);
    scene.materials[1].emission.r = -0.0F;
    const pt::View view = view_of_scene(scene);
    const glm::vec4 emission = view.words[pt::SceneBlocks(view.features).emission];
    EXPECT_EQ(emission.g, 60.0F);
    EXPECT_EQ(emission.r, 0.0F);
    EXPECT_FALSE(std::signbit(emission.r));
}

} // namespace
