// A walk in steps (tree_path.glsl) gives the bits of a whole walk, if the driver neither contracts nor reorders.
#include "tests/geometry/tree_scenes.h"
#include "tests/kernel/kernel_render.h"
#include "tests/support/checked_scene_of.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace {

double mean_of(const std::vector<float> &values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

pt::PreparedScene all_in_a_tree(const pt::Scene &scene) {
    const std::vector<pt_sphere> spheres = caller_spheres(scene.spheres);
    return prepared_scene_of({scene.materials, {spheres, {}}, scene.planes}, 1);
}

TEST(TreePath, TakeTheSamplesOfWholeWalks) {
    TreeScenes scenes(23);
    const bool is_exact = probe_device().info().kind == PT_DEVICE_CPU;
    int beyond_branches = 0;
    for (const std::uint32_t length : {1U, 2U, 3U, 4U, 9U}) {
        const pt::Scene scene = scenes.next(250);
        pt::Camera camera = scenes.camera(scene);
        if (length % 2 == 1) {
            camera.lens_radius = 0.05;
            camera.focus = 2.0;
        }
        KernelRender render(pt::view_of(all_in_a_tree(scene), camera, KernelRender::settings(length)));
        SCOPED_TRACE(std::to_string(scene.spheres.size()) + " spheres, " + scenes.kind() + ", length " +
                     std::to_string(length));
        const std::uint32_t lamps = render.features()[pt::gpu::ID_LAMP_COUNT];
        beyond_branches += lamps > pt::branch_count(render.features()) && lamps <= pt::gpu::EVERY_LAMP_LIMIT ? 1 : 0;
        render.take(length > 4 ? 4 : 8);
        Probe whole = render.probe_of_tree();
        const KernelRender::FilmWords expected = render.film_by(whole);
        Probe steps = render.probe_of_tree(8);
        const KernelRender::FilmWords found = render.film_by(steps);
        EXPECT_TRUE(found == expected || !is_exact);
        const double mean = mean_of(render.radiance(expected));
        EXPECT_NEAR(mean_of(render.radiance(found)), mean, 1e-4 * mean);
    }
    EXPECT_GT(beyond_branches, 0);
}

TEST(TreePath, LastDirectionsFindAllLampsOfAList) {
    std::vector<pt_sphere> lamps;
    for (int i = 0; i < 24; ++i)
        lamps.push_back({{0.8 * (i % 6) - 2.0, 0.5, -0.8 * (i / 6) - 3.0}, 0.3, {0, 0, 0}, 0, 0});
    const pt::Material lamp{glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(1.0F), 0.0F};
    const pt::Material matt{glm::vec3(0.7F), glm::vec3(0.0F), glm::vec3(0.0F), 0.0F};
    const pt::Camera camera{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 1.0, 0.0, 1.0};
    pt::RenderSettings settings = KernelRender::settings(2);
    settings.estimator = PT_ESTIMATOR_COSINE;
    const auto render_of = [&](std::uint32_t tree_from) {
        return KernelRender(pt::view_of(
            prepared_scene_of({{lamp, matt}, {lamps, {}}, {{{0, 1, 0}, 1.0, 1}}}, tree_from), camera, settings));
    };
    const KernelRender list = render_of(1000);
    const KernelRender tree = render_of(1);
    ASSERT_EQ(tree.features()[pt::gpu::ID_TREE_LAMPS], lamps.size());
    Probe probe = tree.probe_of_tree();
    const double mean = mean_of(list.radiance(list.film(pt::gpu::SCENE_IN_UNIFORM, list.words())));
    EXPECT_GT(mean, 0.05);
    EXPECT_NEAR(mean_of(tree.radiance(tree.film_by(probe))), mean, 1e-3 * mean);
}

} // namespace
