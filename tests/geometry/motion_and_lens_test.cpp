#include "tests/support/batch_fixture.h"
#include "tests/support/light_in_double.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace motion_and_lens {

namespace {

constexpr double comparisons = 2;
constexpr uint32_t lamp_batches = 16;
const double allowed_deviation = student_bound(1e-6 / comparisons, lamp_batches);

struct FloorBall {
    double radius;
    double motion[3];
};

class HugeMotion : public BatchFixture {
protected:
    void set_up_floor(const FloorBall &floor, double shutter_open = 0, double shutter_close = 1) {
        const pt_material materials[] = {{{0, 0, 0}, {0, 0, 0}, {10, 10, 10}, 0, 0},
                                         {{0.8F, 0.8F, 0.8F}, {0, 0, 0}, {0, 0, 0}, 0, 0}};
        const pt_sphere spheres[] = {
            {{3, 2, 0}, 1, {0, 0, 0}, 0, 0},
            {{0, -1 - floor.radius, 0}, floor.radius, {floor.motion[0], floor.motion[1], floor.motion[2]}, 1, 0}};
        const pt_scene scene = scene_of(materials, spheres, {});
        pt_camera camera = camera_at({0, 0, 0}, {0.3, -1, -0.4}, 0.5);
        camera.shutter_open = shutter_open;
        camera.shutter_close = shutter_close;
        set_up(scene, camera);
    }

    Estimate light(uint32_t batch_count, uint32_t samples) {
        const Batches batches = render_batches(render_of(8, 8, 2), batch_count, samples);
        std::vector<std::size_t> pixels(batches.front().size());
        std::iota(pixels.begin(), pixels.end(), std::size_t{0});
        return estimate_over(batches, pixels);
    }

    std::string refusal() {
        const pt_accumulate_info info = accumulate_info(1);
        const pt_result result = pt_accumulate(context(), &info);
        EXPECT_TRUE(result == PT_OK || result == PT_ERROR_UNSUPPORTED) << pt_last_error(context());
        return result == PT_OK ? "" : pt_last_error(context());
    }
};

TEST_F(HugeMotion, LampsAreSeenFromOutside) {
    constexpr double radius = 1e6;
    const pt_material materials[] = {{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0}, {{0, 0, 0}, {0, 0, 0}, {4, 4, 4}, 0, 0}};
    const pt_sphere spheres[] = {{{0, -1e-3 - radius, 0}, radius, {1e3, 0, 0}, 0, 0}, {{0, 50, 0}, 5, {0, 0, 0}, 1, 0}};
    const pt_camera camera = camera_at({0, 0, 0}, {0, 1, 0}, 0.1, {0, 0, 1});
    for (const float value : render_image(context(), scene_of(materials, spheres, {}), camera, render_of(8, 8, 1), 256))
        EXPECT_EQ(value, 4.0F) << "the lamp overhead fills the view";
}

// The lamp is 3 above the floor. Its light is about height^-2, and the height changes by 1/4. The midpoint rule has an
// error of (1/4)^2 * 6 / 24 / 32^2 = 2e-5.
TEST_F(HugeMotion, IsTheMeanOfFrozenTimes) {
    constexpr uint32_t times = 32;
    for (const FloorBall &floor : {FloorBall{1e7, {3, 0.5, -2}}, FloorBall{1e5, {1000, 0.25, 0}}}) {
        double mean = 0.0;
        double square = 0.0;
        for (uint32_t i = 0; i < times; ++i) {
            set_up_floor(floor, (i + 0.5) / times, (i + 0.5) / times);
            const Estimate frozen = light(2, 64);
            mean += frozen.mean / times;
            square += std::pow(frozen.standard_error / times, 2);
        }
        set_up_floor(floor);
        const Estimate moving = light(lamp_batches, 1024);
        const double error = std::hypot(moving.standard_error, std::sqrt(square), 1e-4 * mean);
        EXPECT_LT(std::abs(moving.mean - mean) / error, allowed_deviation) << floor.radius;
        // Negative control: the opposite vertical motion.
        set_up_floor({floor.radius, {floor.motion[0], -floor.motion[1], floor.motion[2]}});
        EXPECT_GT(std::abs(light(lamp_batches, 1024).mean - mean) / error, allowed_deviation) << floor.radius;
    }
}

TEST_F(HugeMotion, IsRefusedWhereItIsTooLong) {
    const pt_render render = render_of(8, 8, 2);
    ASSERT_EQ(pt_set_render(context(), &render), PT_OK);
    set_up_floor({1e7, {312499, 0, 0}});
    EXPECT_EQ(refusal(), "");
    set_up_floor({1e7, {312501, 0, 0}});
    EXPECT_EQ(refusal(), "spheres[1].motion = (312501, 0, 0): must be less than a 32nd of the radius (1e+07) while the "
                         "shutter is open, because the surface is nearer than a 65536th of it to the camera");
    set_up_floor({1e7, {312501, 0, 0}}, 0.25, 0.5);
    EXPECT_EQ(refusal(), "") << "while the shutter is open it moves less";
    set_up_floor({6e4, {1e6, 0, 0}});
    EXPECT_EQ(refusal(), "") << "held by its center";
}

// Parallel views have no distance, so the rule uses the view's width.
TEST_F(HugeMotion, IsRefusedInNarrowParallelViews) {
    const pt_material shining{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0};
    const pt_sphere globe{{0, -1e7, 0}, 1e7, {1e6, 0, 0}, 0, 0};
    const pt_render render = render_of(8, 8, 1);
    ASSERT_EQ(pt_set_render(context(), &render), PT_OK);
    for (const double height : {1.0, 1e3, 1e6})
        for (const double extent : {1e3, 10.0}) {
            pt_camera camera = camera_at({0, height, 0}, {1e-3 * height, 0, 0}, 0.0, {0, 0, 1});
            camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
            camera.vertical_extent = extent;
            set_up(scene_of({&shining, 1}, {&globe, 1}, {}), camera);
            const std::string message = refusal();
            const bool is_refused = message.starts_with("spheres[0].motion = (1e+06, 0, 0): must be less than") &&
                                    message.find("the start of parallel rays") != std::string::npos;
            EXPECT_TRUE(extent > 10.0 ? message.empty() : is_refused) << height << ": " << message;
        }
}

using Lens = light_in_double::LightInDouble;

// The disc is larger than the image, so brightness is proportional to 1 / radius^2. Negative controls: a lens that is
// 3% wider (6% less light), and a focus that is 3% farther (9%).
TEST_F(Lens, IsAsWideAndFocusedAsStated) {
    using namespace light_in_double;
    Given given;
    given.planes.clear();
    given.spheres = {{{0, 0, 0}, 3, {0, 0, 0}, 2, 0}};
    given.camera = camera_at({0, 0, 20}, {0, 0, 0}, 2.0 * std::atan(6.0 / 20.0));
    given.camera.shutter_close = 0.0;
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

} // namespace

} // namespace motion_and_lens
