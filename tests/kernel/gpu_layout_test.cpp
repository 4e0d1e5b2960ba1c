#include "lib/view/scene_blocks.h"
#include "lib/view/seen_scene.h"
#include "lib/view/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace gpu_layout {

namespace {

pt::Camera camera_at(glm::dvec3 position) {
    return {position, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.25, 0.75};
}

pt::Scene small_scene() {
    pt::Scene scene;
    scene.materials = {{{0.5F, 0.25F, 0}, {0, 0, 0}, {0, 0, 0}, 0},
                       {{0.25F, 0.25F, 0.25F}, {0.75F, 0.75F, 0.75F}, {0, 0, 0}, 40},
                       {{0, 0, 0}, {0, 0, 0}, {30, 60, 90}, 0}};
    scene.spheres = {{{1, 2, 3}, 0.5, {4, 0, 0}, 1}, {{0, 9, 0}, 2, {0, 0, 0}, 2}};
    scene.planes = {{{0, 1, 0}, 4, 0}};
    return scene;
}

pt::View view_from(const pt::Scene &scene, const pt::Camera &camera) {
    return pt::view_of(pt::PreparedScene(scene), camera, {4, 4, 2, 0, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_RANDOM, 0, 4});
}

TEST(GpuLayout, WhatTheSceneDoesNotUseIsNotInTheBuffer) {
    pt::Scene scene = small_scene();
    scene.materials[1].specular = {0, 0, 0};
    scene.spheres[0].motion = {0, 0, 0};
    const pt::View view = view_from(scene, camera_at({0, 0, 1}));
    EXPECT_FALSE(view.features[pt::gpu::ID_GLOSS]);
    EXPECT_FALSE(view.features[pt::gpu::ID_MOTION]);
    EXPECT_EQ(view.words.size(), 9U);
}

TEST(GpuLayout, OtherSpheresKeepTheirCenter) {
    const pt::Material diffuse{{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {0, 0, 0}, 0};
    const pt::Material lamp{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0};
    const pt::Camera camera = camera_at({0, 0, 0});
    const auto below = [](double radius, double height, double motion) {
        return pt::Sphere{{0, -radius - height, 0}, radius, {motion, 0, 0}, 0};
    };
    const auto is_flat = [](const pt::Sphere &sphere, const pt::Material &material, const pt::Camera &seen_from) {
        return pt::SeenSphere(sphere, material, seen_from).is_flat;
    };
    EXPECT_TRUE(is_flat(below(33, 1, 0), diffuse, camera));
    EXPECT_TRUE(is_flat(below(33, -1, 0), diffuse, camera));
    EXPECT_TRUE(is_flat(below(33, 0, 0), diffuse, camera));
    EXPECT_FALSE(is_flat(below(31, 1, 0), diffuse, camera));
    EXPECT_FALSE(is_flat(below(33, -33, 0), diffuse, camera)) << "the camera at its center";
    EXPECT_TRUE(is_flat(below(33, 1, 1), diffuse, camera));
    EXPECT_FALSE(is_flat(below(33, 1, 3), diffuse, camera));
    EXPECT_TRUE(is_flat(below(65537, 1, 0), lamp, camera));
    EXPECT_FALSE(is_flat(below(65535, 1, 0), lamp, camera));
    pt::Camera closed = camera;
    closed.shutter_close = closed.shutter_open;
    EXPECT_TRUE(is_flat(below(33, 1, 1), diffuse, closed)) << "nothing moves while the shutter is shut";
}

TEST(GpuLayout, TheFilmUnitFollowsTheBrightestLampInUse) {
    pt::Scene scene = small_scene();
    EXPECT_EQ(pt::PreparedScene(scene).film_unit, 0.5); // 90 is in [2^6, 2^7).
    scene.materials[2].emission = {1e14F, 0, 0};
    EXPECT_EQ(pt::PreparedScene(scene).film_unit, 0x1p39); // 1e14 is in [2^46, 2^47).
    scene.spheres.pop_back();
    EXPECT_EQ(pt::PreparedScene(scene).film_unit, 1.0); // unused materials do not count
}

// The film rejects negative light, even negative zeros.
TEST(GpuLayout, ALampsNegativeZeroIsZero) {
    pt::Scene scene = small_scene();
    scene.materials[2].emission.r = -0.0F;
    const pt::View view = view_from(scene, camera_at({0, 0, 1}));
    const glm::vec4 emission = view.words[pt::SceneBlocks(view.features).emission];
    EXPECT_EQ(emission.g, 60.0F);
    EXPECT_EQ(emission.r, 0.0F);
    EXPECT_FALSE(std::signbit(emission.r));
}

} // namespace

} // namespace gpu_layout
