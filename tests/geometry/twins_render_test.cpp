// Surfaces that are given twice, exactly or nearly, have the light of a single one.
#include "lib/scene/checked_scene.h"
#include "tests/invariance/invariance_scene.h"
#include "tests/kernel/kernel_render.h"
#include "tests/support/batch_fixture.h"
#include "tests/support/checked_scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace twins_render {

namespace {

constexpr std::uint32_t batch_count = 8;
constexpr std::uint32_t samples = 64;

constexpr double comparisons = 15;

std::vector<double> means_of(const Batches &batches) {
    std::vector<double> means;
    for (const std::vector<double> &image : batches)
        means.push_back(std::accumulate(image.begin(), image.end(), 0.0) / static_cast<double>(image.size()));
    return means;
}

class RenderedTwins : public BatchFixture {
protected:
    Estimate mean_of(const InvarianceScene &scene, std::uint32_t path_length, std::uint64_t first_seed) {
        set_up(scene.scene(), scene.camera);
        pt_render render = render_of(16, 16, path_length);
        render.seed = first_seed;
        const statistics::Moments moments = statistics::moments(means_of(render_batches(render, batch_count, samples)));
        return {moments.mean, std::sqrt(moments.variance / batch_count)};
    }

    // `tolerance` is the relative change of light because of the displacement. The difference of two means of n batches
    // has the bound of one mean of 2 n - 1 batches.
    void expect_light(const Estimate &expected, const InvarianceScene &scene, std::uint32_t path_length,
                      double tolerance) {
        const Estimate found = mean_of(scene, path_length, 200);
        const double error = std::hypot(expected.standard_error, found.standard_error, tolerance * expected.mean);
        const double deviation = error > 0.0 ? (found.mean - expected.mean) / error : 0.0;
        EXPECT_LT(std::abs(deviation), student_bound(1e-6 / comparisons, 2 * batch_count - 1))
            << found.mean << " instead of " << expected.mean << ", path length " << path_length;
    }
};

enum Named { lamp, floor_plane, oblique_plane, room };

InvarianceScene scene_of_named(std::initializer_list<Named> surfaces) {
    InvarianceScene scene;
    scene.materials = {{{0, 0, 0}, {0, 0, 0}, {10, 10, 10}, 0, 0}, {{0.7F, 0.7F, 0.7F}, {0, 0, 0}, {0, 0, 0}, 0, 0}};
    for (const Named surface : surfaces) {
        if (surface == lamp)
            scene.spheres.push_back({{1, 3, 0}, 0.5, {0, 0, 0}, 0, 0});
        if (surface == room)
            scene.spheres.push_back({{0, 0, 0}, 8, {0, 0, 0}, 1, 0});
        if (surface == floor_plane)
            scene.planes.push_back({{0, 1, 0}, 1, 1, 0});
        if (surface == oblique_plane)
            scene.planes.push_back({{0.3, 1, 0.2}, 1, 1, 0});
    }
    scene.camera = {};
    scene.camera.struct_size = sizeof scene.camera;
    scene.camera.position[1] = 1;
    scene.camera.position[2] = 6;
    scene.camera.target[1] = -0.6;
    scene.camera.vertical_fov = 30 * std::numbers::pi / 180;
    return scene;
}

void shift_twins(InvarianceScene &scene, double share) {
    for (std::size_t i = 1; i < scene.spheres.size(); ++i)
        if (scene.spheres[i].radius == scene.spheres[0].radius)
            scene.spheres[i].center[i % 3] += share * scene.spheres[i].radius;
    for (std::size_t i = 1; i < scene.planes.size(); ++i)
        scene.planes[i].offset *= 1 + share;
}

TEST_F(RenderedTwins, SendTheirLightOnce) {
    struct Case {
        std::initializer_list<Named> once;
        std::initializer_list<Named> twice;
        std::uint32_t path_length;
    };
    const Case cases[] = {{{lamp, floor_plane}, {lamp, lamp, floor_plane}, 2},
                          {{lamp, floor_plane}, {lamp, lamp, lamp, floor_plane}, 2},
                          {{lamp, room}, {lamp, lamp, room}, 6},
                          {{room, lamp}, {room, room, lamp}, 6},
                          {{lamp, oblique_plane}, {lamp, oblique_plane, oblique_plane}, 2}};
    for (const auto &[surfaces, repeated, path_length] : cases) {
        const Estimate once = mean_of(scene_of_named(surfaces), path_length, 100);
        for (const double share : {0.0, 1e-6, 1e-4}) {
            SCOPED_TRACE(share);
            InvarianceScene twice = scene_of_named(repeated);
            shift_twins(twice, share);
            // A lamp that is displaced by a fraction of its radius sends at most that fraction more light.
            expect_light(once, twice, path_length, 1e-6 + 2 * share);
        }
    }
}

double mean_light(const KernelRender &render, const KernelRender::Constants &constants) {
    const std::vector<float> image =
        render.radiance(render.film_of_kernel(constants, pt::gpu::SCENE_IN_UNIFORM, render.words()));
    return std::accumulate(image.begin(), image.end(), 0.0) / static_cast<double>(image.size());
}

KernelRender render_with_twins(const InvarianceScene &named) {
    const pt::PreparedScene scene(pt::owned_scene(checked_scene_of(named.scene())));
    const pt::Camera camera = pt::validated_camera(named.camera);
    return KernelRender(
        pt::gpu_scene({pt::seen_scene(scene.scene, camera), false, false}, scene, camera, KernelRender::settings(2)));
}

// Negative control: if twins are not merged, light is doubled or lost.
TEST_F(RenderedTwins, WouldOtherwiseBeSeenTwiceOrNever) {
    const auto light = [](std::initializer_list<Named> surfaces, std::uint32_t known_sides, std::uint32_t close_lamps) {
        const KernelRender render = render_with_twins(scene_of_named(surfaces));
        KernelRender::Constants constants = render.constants();
        EXPECT_EQ(constants[pt::gpu::ID_KNOWN_SIDES], 1U);
        constants[pt::gpu::ID_KNOWN_SIDES] = known_sides;
        constants[pt::gpu::ID_CLOSE_LAMPS] = close_lamps;
        return mean_light(render, constants);
    };
    const double in_room = light({room, lamp}, 1, 0);
    EXPECT_LT(light({room, room, lamp}, 0, 0), 0.99 * in_room);
    EXPECT_NEAR(light({room, room, lamp}, 1, 0), in_room, 0.01 * in_room);
    EXPECT_GT(light({room, lamp, lamp}, 1, 0), 1.2 * in_room);
    EXPECT_NEAR(light({room, lamp, lamp}, 1, 1), in_room, 0.01 * in_room);
}

} // namespace

} // namespace twins_render
