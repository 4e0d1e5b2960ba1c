#include "tests/invariance/invariance_scene.h"
#include "tests/kernel/kernel_render.h"

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

Image image_with_other(const KernelRender &render, std::uint32_t id) {
    KernelRender::Constants constants = render.constants();
    constants[id] = 1 - constants[id];
    return image_with(render, constants);
}

// Counts values that differ by more than rounding along equal paths. A vertex has an error of 2^-24 of its distance.
// Each of two balls magnifies this error by up to 2 distance / radius = 30, so values differ by less than 1e-3.
std::size_t differing_values(const Image &a, const Image &b) {
    const float mean = std::accumulate(a.begin(), a.end(), 0.0F) / static_cast<float>(a.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += std::abs(a[i] - b[i]) > 1e-3F * std::max(a[i], mean) ? 1 : 0;
    return count;
}

// Rounding decides which surface is hit if a ray passes a rim or contact within 2^-20 of the scene's size. With 20 rays
// and 9 surfaces each, on average half a sample of the 3072 is affected. More than 6 samples of 3 values have a
// probability of 1e-6.
constexpr std::size_t decided_by_rounding = 18;

InvarianceScene room() {
    InvarianceScene scene = InvarianceScene::coursework();
    scene.spheres[3].center[0] = 1.0;
    scene.spheres.push_back({{9.5, 1, -14}, 1.5, {0, 0, 0}, 2, 0});
    scene.camera.shutter_close = 1.0;
    return scene;
}

struct Case {
    const char *name;
    InvarianceScene scene;
    std::uint32_t id;
    std::uint32_t constant;
    bool shows; // Whether the inverted constant changes the image.
};

// The last cases are negative controls.
std::vector<Case> cases() {
    InvarianceScene within = room();
    within.spheres.push_back({{0, 0, -5}, 20, {0, 0, 0}, 4, 0});
    InvarianceScene within_alone = within;
    within_alone.planes.clear();
    InvarianceScene emitting = room();
    emitting.planes[1].material = emitting.spheres[0].material;
    InvarianceScene behind = room();
    behind.spheres[0].center[0] = 14;
    return {{"insides, the camera in no ball", room(), gpu::ID_INSIDE, 0, false},
            {"planes as obstacles, no lamp behind one", room(), gpu::ID_PLANES_BLOCK, 0, false},
            {"sides of vertices", room(), gpu::ID_KNOWN_SIDES, 0, false},
            {"sides of vertices, the camera in a ball", within, gpu::ID_KNOWN_SIDES, 1, false},
            {"ends of shadow rays, no lamp close to a ball", room(), gpu::ID_CLOSE_LAMPS, 0, false},
            {"emission of planes, of which one emits", emitting, gpu::ID_PLANES_EMIT, 1, true},
            {"insides, the camera in a ball", within_alone, gpu::ID_INSIDE, 1, true},
            {"planes as obstacles, a lamp behind one", behind, gpu::ID_PLANES_BLOCK, 1, true}};
}

TEST(LeftOut, ShowsWhereItIsNeededAlone) {
    for (const auto &[name, scene, id, constant, shows] : cases()) {
        const KernelRender render = render_of_scene(scene, path_length);
        EXPECT_EQ(render.constants()[id], constant) << name;
        const std::size_t changed =
            differing_values(image_with(render, render.constants()), image_with_other(render, id));
        if (shows)
            EXPECT_GT(changed, 10 * decided_by_rounding) << name;
        else
            EXPECT_LE(changed, decided_by_rounding) << name;
    }
}

// Glossy vertices choose their last direction differently if planes emit.
TEST(LeftOut, EmissionOfPlanesWhereNoneEmits) {
    InvarianceScene scene = room();
    for (pt_material &material : scene.materials)
        std::fill_n(material.specular, 3, 0.0F);
    const KernelRender render = render_of_scene(scene, path_length);
    ASSERT_FALSE(render.features()[gpu::ID_PLANES_EMIT]);
    const Image image = image_with(render, render.constants());
    EXPECT_EQ(image, image_with_other(render, gpu::ID_PLANES_EMIT));
}

} // namespace
