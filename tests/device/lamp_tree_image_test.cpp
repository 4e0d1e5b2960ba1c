// Images with a tree over lamps have the mean of those without. Run alone with --gtest_filter=LampTree*.
#include "lib/kernel/gpu_scene.h"
#include "lib/kernel/prepared_scene.h"
#include "lib/kernel/scene_blocks.h"
#include "shaders/gpu_layout.h"
#include "tests/device/kernel_render.h"
#include "tests/support/lamp_scenes.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

// The same scene for a kernel that has no tree.
pt::GpuScene without_lamp_tree(pt::GpuScene scene) {
    const pt::SceneBlocks blocks(scene.features);
    const auto first = scene.words.begin() + static_cast<std::ptrdiff_t>(blocks.lamp_tree);
    scene.words.erase(first, first + static_cast<std::ptrdiff_t>(blocks.index - blocks.lamp_tree));
    scene.features.lamp_tree = false;
    return scene;
}

std::vector<float> image_of(const pt::GpuScene &scene) {
    const KernelRender render(scene);
    const std::uint32_t source =
        scene.features.scene_in_uniform ? pt::gpu::SCENE_IN_UNIFORM : pt::gpu::SCENE_IN_STORAGE;
    return render.radiance(render.film(source, render.words()));
}

// How many standard errors the mean of one image is off another's, whose pixels are independent.
double deviation(const std::vector<float> &image, const std::vector<float> &other, double factor) {
    std::vector<double> differences;
    for (std::size_t i = 0; i < image.size(); i += 3)
        differences.push_back(factor * static_cast<double>(image[i]) - static_cast<double>(other[i]));
    const statistics::Moments moments = statistics::moments(differences);
    return std::abs(moments.mean) / std::sqrt(moments.variance / static_cast<double>(differences.size()));
}

struct LitScene {
    std::uint32_t lamp_count;
    double motion;
    std::uint32_t path_length;
};

// A floor and balls under lamps that the camera does not see; the second scene is in the storage buffer. Five standard
// errors at most: a false alarm in 10^6 runs.
TEST(LampTreeImage, HasTheMeanOfOneWithoutTheTree) {
    for (const auto &[count, motion, path_length] :
         {LitScene{70, 2.0, 3}, LitScene{500, 0.0, 2}, LitScene{40, 0.0, 4}}) {
        pt::Scene scene = lamp_scenes::in_a_box(count, 4, motion);
        for (pt::Sphere &lamp : scene.spheres)
            lamp.center += glm::dvec3(0, 5, 0);
        scene.materials.push_back({glm::vec3(0.7F), glm::vec3(0), glm::vec3(0), 0});
        const auto grey = static_cast<std::uint32_t>(scene.materials.size() - 1);
        for (int i = 0; i < 3; ++i)
            scene.spheres.push_back({{2.0 * i - 2, -1.5, -6}, 0.5, glm::dvec3(0), grey});
        scene.planes.push_back({{0, 1, 0}, 2, grey});
        const pt::GpuScene with =
            pt::gpu_scene(pt::PreparedScene(scene), lamp_scenes::camera(), KernelRender::settings(path_length));
        ASSERT_TRUE(with.features.lamp_tree);
        const std::vector<float> image = image_of(with);
        const std::vector<float> other = image_of(without_lamp_tree(with));
        EXPECT_NE(image, other);
        EXPECT_LT(deviation(image, other, 1.0), 5.0) << count;
        EXPECT_GT(deviation(image, other, 1.1), 5.0) << "a tenth more light must show";
    }
}

} // namespace
