#include "lib/view/scene_blocks.h"
#include "lib/view/view.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <cstdint>

namespace {

pt::View row_of_balls(std::uint32_t count, std::uint32_t materials) {
    pt::Scene scene;
    scene.materials.assign(materials, {glm::vec3(0.5F), glm::vec3(0), glm::vec3(0), 0});
    scene.materials.push_back({glm::vec3(0), glm::vec3(0), glm::vec3(1), 0});
    scene.spheres = {{{0, 5, -9}, 1, {0, 0, 0}, materials}};
    for (std::uint32_t i = 1; i < count; ++i)
        scene.spheres.push_back({{i, 0, -9}, 0.25, {0, 0, 0}, i % materials});
    const pt::Camera camera{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.0, 0.0};
    return pt::view_of(pt::PreparedScene(scene), camera, {4, 4, 2, 0, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_RANDOM, 0, 4});
}

// 341 surfaces of three words leave one word of the uniform buffer free.
TEST(SceneBlocks, ShareMaterialsInScenesTooLargeForTheUniformBuffer) {
    const pt::View small = row_of_balls(341, 1);
    EXPECT_TRUE(small.features.scene_in_uniform());
    EXPECT_EQ(small.features.table_materials, 0U);
    EXPECT_EQ(small.words.size(), 3U * 341);

    const pt::View large = row_of_balls(342, 1);
    EXPECT_FALSE(large.features.scene_in_uniform());
    EXPECT_EQ(large.features.table_materials, 2U);
    EXPECT_EQ(large.words.size(), 342U + 1 + 86 + 2) << "geometry, the lamp's emission, indices, table";
    EXPECT_EQ(row_of_balls(342, 100).words.size(), 342U + 1 + 86 + 101);
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

} // namespace
