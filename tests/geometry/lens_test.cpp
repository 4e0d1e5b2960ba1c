#include "tests/support/light_in_double.h"

#include <pt/film.h>
#include <pt/stats.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lens {

namespace {

using namespace light_in_double;

Given random_balls(std::uint32_t seed, std::uint32_t count, double distance) {
    Given given = random_scene(seed, 0, count, distance);
    given.camera.aperture = 0.25 * distance; // A point 2 behind the focus spreads over a disc of radius 0.25.
    given.camera.focus = distance - 1.0;
    return given;
}

using Lens = LightInDouble;

// The disc is larger than the image, so brightness is proportional to 1 / radius^2. Negative controls: a lens that is
// 3% wider (6% less light), and a focus that is 3% farther (9%).
TEST_F(Lens, IsAsWideAndFocusedAsStated) {
    Given given;
    given.planes.clear();
    given.spheres = {{{0, 0, 0}, 3, {0, 0, 0}, 2, 0}};
    given.camera.struct_size = sizeof given.camera;
    given.camera.position[2] = 20;
    given.camera.up[1] = 1;
    given.camera.vertical_fov = 2.0 * std::atan(6.0 / 20.0);
    given.camera.aperture = 8.4;
    given.camera.focus = 6.0;
    const pt_render render = picture_of(PT_SAMPLER_SOBOL);
    const Blocks exact = exact_blocks(given, 10'000);
    const auto error = [&](const Given &other) {
        const Deviation found = deviation(context(), other, exact, render);
        return std::max(std::abs(found.of_image), found.largest);
    };
    EXPECT_LT(error(given), most_errors);
    Given wider = given;
    wider.camera.aperture *= 1.03;
    EXPECT_GT(error(wider), most_errors);
    Given farther = given;
    farther.camera.focus *= 1.03;
    EXPECT_GT(error(farther), most_errors);
}

// First hits use the pinhole at the lens's center.
TEST_F(Lens, WithoutADiameterIsAPinhole) {
    Given lens = random_balls(1, 7, 8.0);
    Given pinhole = lens;
    pinhole.camera.aperture = 0.0;
    const pt_render render = picture_of(PT_SAMPLER_SOBOL);
    const std::vector<float> of_pinhole = render_image(context(), pinhole.scene(), pinhole.camera, render, 4);
    EXPECT_FALSE(stats().features & PT_FEATURE_LENS);
    Given unfocused = pinhole;
    unfocused.camera.focus = 0.0;
    EXPECT_EQ(render_image(context(), unfocused.scene(), unfocused.camera, render, 4), of_pinhole);
    std::vector<float> first_hits(of_pinhole.size());
    std::vector<float> through_lens(of_pinhole.size());
    for (const std::uint32_t quantity : {PT_QUANTITY_DEPTH, PT_QUANTITY_NORMAL, PT_QUANTITY_ALBEDO}) {
        const auto read = [&](const Given &given, std::vector<float> &values) {
            ASSERT_EQ(pt_set_camera(context(), &given.camera), PT_OK) << pt_last_error(context());
            const pt_image target = image_target(values, quantity);
            ASSERT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
        };
        read(pinhole, first_hits);
        read(lens, through_lens);
        for (std::size_t i = 0; i < first_hits.size(); ++i) {
            const bool is_equal = through_lens[i] == first_hits[i];
            EXPECT_TRUE(is_equal || std::abs(through_lens[i] - first_hits[i]) <= 1e-6 * std::max(1.0F, first_hits[i]))
                << quantity << ": " << through_lens[i] << " and " << first_hits[i];
        }
    }
    EXPECT_NE(render_image(context(), lens.scene(), lens.camera, render, 4), of_pinhole);
}

} // namespace

} // namespace lens
