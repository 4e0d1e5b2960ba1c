// Code that the kernel omits because a scene does not need it changes no picture: the handling of insides where the
// camera is in no sphere, planes as obstacles where no lamp is behind one, and as lights where none emits; the sides of
// vertices and the ends of shadow rays.
#include "tests/device/kernel_render.h"
#include "tests/invariance/invariance_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace {

namespace gpu = pt::gpu;

using Image = std::vector<float>;

constexpr std::uint32_t path_length = 3;

Image image_with(const KernelRender &render, const KernelRender::Constants &constants) {
    return render.radiance(render.film_of_kernel(constants, gpu::SCENE_IN_UNIFORM, render.words()));
}

// The image of a kernel that has one of its constants turned over.
Image image_with_other(const KernelRender &render, std::uint32_t id) {
    KernelRender::Constants constants = render.constants();
    constants[id] = 1 - constants[id];
    return image_with(render, constants);
}

// Values that differ by more than the rounding of paths whose rays meet the same surfaces. A vertex is off by some
// 2^-24 of its distance; each ball on the way magnifies that by at most twice its distance over its radius, here 30, so
// two of them keep it below 1e-3 of the light.
std::size_t differing_values(const Image &a, const Image &b) {
    const float mean = std::accumulate(a.begin(), a.end(), 0.0F) / static_cast<float>(a.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += std::abs(a[i] - b[i]) > 1e-3F * std::max(a[i], mean) ? 1 : 0;
    return count;
}

std::size_t values_changed_by(const KernelRender &render, std::uint32_t id) {
    return differing_values(image_with(render, render.constants()), image_with_other(render, id));
}

// Rounding decides what a ray meets where it passes a rim, or leaves a point where two surfaces meet, by 2^-20 of the
// scene or less: among 3072 samples, each of some 20 rays against 9 surfaces, half a time on average. More than 6 such
// samples, of 3 values each, come with a probability of 1e-6.
constexpr std::size_t decided_by_rounding = 18;

// Balls that pass through each other, a floor and a wall, one of them on the move. All lamps are in the room.
InvarianceScene room() {
    InvarianceScene scene = InvarianceScene::coursework();
    scene.spheres[3].center[0] = 1.0;
    scene.spheres.push_back({{9.5, 1, -14}, 1.5, {0, 0, 0}, 2, 0});
    scene.camera.shutter_close = 1.0;
    return scene;
}

TEST(LeftOut, InsidesOfSpheresWhereTheCameraIsInNone) {
    const KernelRender render = render_of_scene(room(), path_length);
    ASSERT_FALSE(render.features().inside);
    EXPECT_LE(values_changed_by(render, gpu::ID_INSIDE), decided_by_rounding);
}

TEST(LeftOut, PlanesAsObstaclesWhereNoLampIsBehindOne) {
    const KernelRender render = render_of_scene(room(), path_length);
    ASSERT_FALSE(render.features().planes_block);
    ASSERT_EQ(render.features().plane_count, 4U);
    EXPECT_LE(values_changed_by(render, gpu::ID_PLANES_BLOCK), decided_by_rounding);
}

// The same bits: light that is not there is 0. Without gloss, as glossy vertices choose their last direction otherwise
// where planes emit.
TEST(LeftOut, EmissionOfPlanesWhereNoneEmits) {
    InvarianceScene scene = room();
    for (pt_material &material : scene.materials)
        std::fill_n(material.specular, 3, 0.0F);
    const KernelRender render = render_of_scene(scene, path_length);
    ASSERT_FALSE(render.features().planes_emit);
    const Image image = image_with(render, render.constants());
    EXPECT_EQ(image, image_with_other(render, gpu::ID_PLANES_EMIT));
}

// Where the camera tells the side of surfaces, vertices would tell the same, but for rounding.
TEST(LeftOut, SidesOfVerticesWhereTheCameraTellsThem) {
    InvarianceScene inside = room();
    inside.spheres.push_back({{0, 0, -5}, 20, {0, 0, 0}, 4, 0});
    for (const InvarianceScene &scene : {room(), inside}) {
        const KernelRender render = render_of_scene(scene, path_length);
        ASSERT_EQ(render.features().known_sides, render.features().inside);
        EXPECT_LE(values_changed_by(render, gpu::ID_KNOWN_SIDES), decided_by_rounding);
    }
}

// Which end of a shadow ray counts matters to lamps that are close to other spheres alone.
TEST(LeftOut, EndsOfShadowRaysWhereNoLampIsCloseToASphere) {
    const KernelRender render = render_of_scene(room(), path_length);
    ASSERT_FALSE(render.features().close_lamps);
    EXPECT_LE(values_changed_by(render, gpu::ID_CLOSE_LAMPS), decided_by_rounding);
}

// Negative controls: what the scene needs is left out, which must show.
TEST(LeftOut, EmissionOfPlanesShowsWhereOneEmits) {
    InvarianceScene scene = room();
    scene.planes[1].material = scene.spheres[0].material;
    const KernelRender render = render_of_scene(scene, path_length);
    ASSERT_TRUE(render.features().planes_emit);
    EXPECT_GT(values_changed_by(render, gpu::ID_PLANES_EMIT), 10 * decided_by_rounding);
}

TEST(LeftOut, InsidesOfSpheresShowWhereTheCameraIsInOne) {
    InvarianceScene scene = room();
    scene.planes.clear();
    scene.spheres.push_back({{0, 0, -5}, 20, {0, 0, 0}, 4, 0});
    const KernelRender render = render_of_scene(scene, path_length);
    ASSERT_TRUE(render.features().inside);
    EXPECT_GT(values_changed_by(render, gpu::ID_INSIDE), 10 * decided_by_rounding);
}

TEST(LeftOut, PlanesAsObstaclesShowWhereALampIsBehindOne) {
    InvarianceScene scene = room();
    scene.spheres[0].center[0] = 14;
    const KernelRender render = render_of_scene(scene, path_length);
    ASSERT_TRUE(render.features().planes_block);
    EXPECT_GT(values_changed_by(render, gpu::ID_PLANES_BLOCK), 10 * decided_by_rounding);
}

} // namespace
