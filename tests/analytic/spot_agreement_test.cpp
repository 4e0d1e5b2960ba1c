// Tests that rays through spots (shaders/spots.glsl) change only the noise.
#include "tests/analytic/analytic_fixture.h"
#include "tests/support/batch_fixture.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <vector>

namespace {

using namespace analytic;

constexpr std::uint32_t spot_batch_count = 24;

struct SpotScene {
    const char *name;
    pt_material floor;
    pt_material ball;
    pt_sphere lamp;
};

pt_material diffuse(float albedo) {
    return {{albedo, albedo, albedo}, {0, 0, 0}, {0, 0, 0}, 0, 0};
}

pt_material polished(float albedo, float specular, float glossiness) {
    return {{albedo, albedo, albedo}, {specular, specular, specular}, {0, 0, 0}, glossiness, 0};
}

class SpotAgreement : public AnalyticFixture, public testing::WithParamInterface<SpotScene> {
protected:
    void render_with(float lamp_radiance) {
        const SpotScene &of = GetParam();
        const std::array<pt_material, 4> materials = {
            {{{0, 0, 0}, {0, 0, 0}, {lamp_radiance, lamp_radiance, lamp_radiance}, 0, 0},
             of.floor,
             diffuse(0.7F),
             of.ball}};
        const std::array<pt_sphere, 2> spheres = {of.lamp, {{-1, 0.9, -4.5}, 0.7, {0, 0, 0}, 3, 0}};
        const std::array<pt_plane, 2> planes = {{{{0, 1, 0}, 0, 1, 0}, {{0, 0, 1}, 8, 2, 0}}};
        pt_camera camera{};
        camera.struct_size = sizeof camera;
        camera.position[1] = 1.5;
        camera.target[1] = 1.3;
        camera.target[2] = -8;
        camera.up[1] = 1;
        camera.shutter_close = 1;
        camera.vertical_fov = std::numbers::pi / 4;
        set_up(scene_of(materials, spheres, planes), camera);
    }

    std::vector<std::size_t> pixels_without_lamp() {
        const Batches emission = render_batches(render_of(32, 16, 1), 1, 256);
        std::vector<std::size_t> pixels;
        for (std::size_t pixel = 0; pixel < emission[0].size(); ++pixel)
            if (emission[0][pixel] == 0.0)
                pixels.push_back(pixel);
        return pixels;
    }

    Estimate mean_of(const std::vector<std::size_t> &pixels, std::uint32_t estimator, std::uint32_t max_path_length) {
        pt_render render = render_of(32, 16, max_path_length);
        render.estimator = estimator;
        render.seed = 1000 * estimator;
        return estimate_over(render_batches(render, spot_batch_count, estimator == PT_ESTIMATOR_BSDF ? 1024 : 256),
                             pixels);
    }
};

// The bound is five standard errors, with one false alarm in two million comparisons.
const double spot_bound = student_bound(std::erfc(5.0 / std::sqrt(2.0)), spot_batch_count);

// PT_TEST_MANY adds longer paths. The noise is 0.3%, so errors of 3% are detected.
TEST_P(SpotAgreement, WithDirectionsByChance) {
    for (const std::uint32_t length : {3U, 5U}) {
        if (length > 3 && !std::getenv("PT_TEST_MANY"))
            continue;
        render_with(70.0F);
        const std::vector<std::size_t> pixels = pixels_without_lamp();
        ASSERT_GT(pixels.size(), 400U);
        const Estimate chance = mean_of(pixels, PT_ESTIMATOR_BSDF, length);
        const Estimate spots = mean_of(pixels, PT_ESTIMATOR_MIS, length);
        const double error = std::hypot(spots.standard_error, chance.standard_error, 1e-6 * chance.mean);
        std::printf("%s, length %u: %.6f +- %.6f, by chance %.6f +- %.6f, deviation %.2f\n", GetParam().name, length,
                    spots.mean, spots.standard_error, chance.mean, chance.standard_error,
                    (spots.mean - chance.mean) / error);
        EXPECT_LT(std::abs(spots.mean - chance.mean), spot_bound * error);
        EXPECT_LT(error, 0.004 * chance.mean) << "too noisy to tell anything";
    }
}

INSTANTIATE_TEST_SUITE_P(
    Of, SpotAgreement,
    testing::Values(
        SpotScene{"All", polished(0.4F, 0.5F, 200), polished(0, 0.9F, 300), {{0.3, 0.7, -4}, 0.15, {0, 0, 0}, 0, 0}},
        SpotScene{"Moving", diffuse(0.5F), polished(0.1F, 0.6F, 200), {{0.3, 0.7, -4}, 0.15, {0.5, 0.2, 0}, 0, 0}}),
    [](const auto &param) { return param.param.name; });

} // namespace
