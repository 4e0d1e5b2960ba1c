#include "tests/analytic/analytic_fixture.h"
#include "tests/analytic/scenes.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace {

using namespace analytic;

class ExactLight : public AnalyticFixture {
protected:
    Image render(const cli::SceneFile &scene, std::uint32_t max_path_length, std::uint32_t estimator) {
        pt_render settings = render_of(scene.render.width, scene.render.height, max_path_length);
        settings.estimator = estimator;
        return image_of(scene.scene(), scene.camera, settings, 64);
    }
};

double largest_error(const Image &image, double exact) {
    double largest = 0.0;
    for (const float value : image.radiance)
        largest = std::max(largest, std::abs(value / exact - 1.0));
    return std::ldexp(largest, 24);
}

TEST_F(ExactLight, FromASphereItselfItsFarSideIsSeen) {
    for (const float emission : {0.0F, 0.5F}) {
        // The lamp behind the sphere would show a leak. Lamps and black spheres are stored differently, so both
        // are tested.
        const pt_material materials[] = {{{0, 0, 0}, {0, 0, 0}, {emission, emission, emission}, 0, 0},
                                         {{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0}};
        const pt_sphere spheres[] = {{{0, 0, -1}, 1, {0, 0, 0}, 0, 0}, {{0, 0, -1}, 50, {0, 0, 0}, 1, 0}};
        const pt_scene scene = scene_of(materials, spheres, {});
        const pt_camera camera = camera_at({0, 0, 0}, {0, 0, -1});
        for (const float value : image_of(scene, camera, render_of(16, 16, 1), 16).radiance)
            ASSERT_EQ(value, emission);
    }
}

TEST_F(ExactLight, InsideALampIsItsEmission) {
    const cli::SceneFile scene = read_scene("08-inside");
    for (const std::uint32_t length : {1U, 2U, 64U})
        EXPECT_EQ(largest_error(render(scene, length, PT_ESTIMATOR_BEST), 0.1F), 0.0) << "path length " << length;
    EXPECT_GT(largest_error(render(scene, 1, PT_ESTIMATOR_BEST), 0.1F * 1.03), 0.0);
}

// Every path ends on a lamp of emission 1 after one reflection with the weight (albedo / pi * cos) / (cos / pi). The
// tolerance allows five operations with an error of 2^-24 each.
TEST_F(ExactLight, FurnaceIsWhite) {
    const cli::SceneFile scene = read_scene("09-furnace");
    for (const std::uint32_t estimator : {PT_ESTIMATOR_COSINE, PT_ESTIMATOR_BSDF, PT_ESTIMATOR_MIS})
        for (const std::uint32_t length : {2U, 5U}) {
            const double error = largest_error(render(scene, length, estimator), 1.0);
            EXPECT_LE(error, 5.0) << "estimator " << estimator << ", path length " << length;
        }
    cli::SceneFile brighter = scene;
    brighten(brighter, 1.000001F);
    EXPECT_GT(largest_error(render(brighter, 2, PT_ESTIMATOR_BSDF), 1.0), 5.0);
}

} // namespace
