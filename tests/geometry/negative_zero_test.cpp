// -0 in a scene is zero, not negative light.
#include "tests/invariance/invariance_scene.h"
#include "tests/kernel/kernel_render.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace {

using Image = std::vector<float>;

constexpr std::uint32_t zero_width = 16;
constexpr std::uint32_t zero_height = 12;

InvarianceScene scene_with_zeros(float zero) {
    InvarianceScene scene = InvarianceScene::coursework();
    scene.materials[1].emission[2] = 0;
    for (pt_material &material : scene.materials)
        for (float *color : {material.diffuse, material.specular, material.emission})
            for (int i = 0; i < 3; ++i)
                color[i] = color[i] == 0.0F ? zero : color[i];
    return scene;
}

class NegativeZero : public ContextFixture {
protected:
    Image image_of(const InvarianceScene &zeros, std::uint32_t max_path_length) {
        const pt_scene scene = zeros.scene();
        const pt_render render = ::render_of(zero_width, zero_height, max_path_length);
        set_picture(context(), scene, zeros.camera, render);
        accumulate(16);
        EXPECT_EQ(stats().rejected_samples, 0U);
        Image image(std::size_t{3} * zero_width * zero_height);
        readback(image);
        return image;
    }
};

TEST_F(NegativeZero, OfMaterialsIsZero) {
    for (const std::uint32_t max_path_length : {1U, 3U})
        EXPECT_EQ(image_of(scene_with_zeros(-0.0F), max_path_length), image_of(scene_with_zeros(0.0F), max_path_length))
            << "vertices: " << max_path_length;
}

TEST(NegativeZeroInTheSceneBuffer, IsRejected) {
    const KernelRender render = render_of_scene(scene_with_zeros(0.0F), 1);
    std::vector<glm::vec4> words = render.words();
    const auto rejected_samples = [&] {
        const KernelRender::FilmWords film = render.film(pt::gpu::SCENE_IN_UNIFORM, words);
        std::uint32_t rejected = 0;
        for (std::size_t pixel = 0; pixel < KernelRender::width * KernelRender::height; ++pixel)
            rejected += film[pt::gpu::FILM_REJECTED * KernelRender::width * KernelRender::height + pixel];
        return rejected;
    };
    EXPECT_EQ(rejected_samples(), 0U);
    const std::uint32_t surfaces = render.features().surface_count();
    for (std::uint32_t surface = 0; surface < surfaces; ++surface)
        for (int channel = 0; channel < 3; ++channel)
            if (words[surfaces + surface][channel] == 0.0F)
                words[surfaces + surface][channel] = -0.0F;
    EXPECT_GT(rejected_samples(), 0U);
}

} // namespace
