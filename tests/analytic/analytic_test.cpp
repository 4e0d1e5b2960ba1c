#include "tests/analytic/analytic_fixture.h"
#include "tests/analytic/crop.h"
#include "tests/analytic/scenes.h"
#include "tests/support/render_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace analytic;

constexpr std::uint32_t batch_count = 16;

// Returns a power of two, because Sobol points are most even at such counts.
std::uint32_t samples_for(const Crop &crop, const cli::SceneFile &scene) {
    const double paths = (1U << 21) / (always_tree() ? 8 : 1);
    const double surfaces = static_cast<double>(scene.spheres.size() + scene.planes.size());
    const double samples = paths / (batch_count * crop.width * crop.height * (1.0 + 0.05 * surfaces));
    return std::bit_floor(static_cast<std::uint32_t>(std::clamp(samples, surfaces > 100.0 ? 2.0 : 16.0, 4096.0)));
}

struct Measurement {
    std::uint32_t sample_count;
    Estimate radiance;
};

double bound_of(const Measurement &measured, const Exact &exact) {
    return std::min(tabulated_bound(exact, measured.sample_count), batch_bound(measured.radiance, exact, batch_count));
}

bool measurement_agrees(const Measurement &measured, const Exact &exact) {
    return std::abs(measured.radiance.mean - exact.radiance) <= bound_of(measured, exact);
}

bool resolves(const Measurement &measured, const Exact &exact) {
    return 0.03 * exact.radiance > 2.0 * bound_of(measured, exact);
}

class Analytic : public AnalyticFixture, public testing::WithParamInterface<Expectation> {
protected:
    Measurement measure(const cli::SceneFile &scene, const Pixel &pixel) {
        const Crop crop = crop_around(scene.render.width, scene.render.height, pixel.x, pixel.y);
        const std::uint32_t samples = samples_for(crop, scene);
        set_up(scene.scene(), cropped(scene.camera, scene.render.height, crop.height));
        pt_render settings = render_of(crop.width, crop.height, scene.render.max_path_length);
        settings.first_row = crop.y;
        settings.row_count = 1;
        return {batch_count * samples, estimate_of_pixel(render_batches(settings, batch_count, samples), crop.x)};
    }

    // Negative control: values that are 3% wrong, and lamps that are 3% brighter.
    void expect_to_see_errors(cli::SceneFile scene, const Pixel &pixel, const Measurement &measured) {
        for (const double factor : {0.97, 1.03}) {
            const Exact wrong{pixel.exact.radiance * factor, pixel.exact.relative_std};
            EXPECT_FALSE(measurement_agrees(measured, wrong)) << pixel.x << ", " << pixel.y;
        }
        brighten(scene, 1.03F);
        EXPECT_FALSE(measurement_agrees(measure(scene, pixel), pixel.exact)) << pixel.x << ", " << pixel.y;
    }
};

TEST_P(Analytic, PixelsAreExact) {
    const Expectation &expectation = GetParam();
    const cli::SceneFile scene = read_scene(expectation.scene);
    bool sees_errors = false;
    for (const Pixel &pixel : expectation.pixels) {
        const Measurement measured = measure(scene, pixel);
        const bool exact = measurement_agrees(measured, pixel.exact);
        EXPECT_TRUE(exact) << pixel.x << ", " << pixel.y << ": " << measured.radiance.mean << " +- "
                           << measured.radiance.standard_error << ", expected " << pixel.exact.radiance;
        if (exact && !sees_errors && resolves(measured, pixel.exact)) {
            sees_errors = true;
            expect_to_see_errors(scene, pixel, measured);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Tabulated, Analytic, testing::ValuesIn(read_expectations()), [](const auto &param) {
    std::string name = "Scene" + param.param.scene;
    for (char &c : name)
        c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
});

class OnASphere : public AnalyticFixture {};

// The lamp behind the sphere would show a leak. Lamps and black spheres are stored differently, so both are tested.
TEST_F(OnASphere, ItsFarSideIsSeen) {
    for (const float emission : {0.0F, 0.5F}) {
        const pt_material materials[] = {{{0, 0, 0}, {0, 0, 0}, {emission, emission, emission}, 0, 0},
                                         {{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0}};
        const pt_sphere spheres[] = {{{0, 0, -1}, 1, {0, 0, 0}, 0, 0}, {{0, 0, -1}, 50, {0, 0, 0}, 1, 0}};
        for (const float value : render_image(context(), scene_of(materials, spheres, {}),
                                              camera_at({0, 0, 0}, {0, 0, -1}), render_of(16, 16, 1), 16))
            ASSERT_EQ(value, emission);
    }
}

} // namespace
