#include "tests/support/batch_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace {

constexpr double motion_comparisons = 200;
double allowed_deviation(std::size_t batch_count) {
    return student_bound(1e-6 / motion_comparisons, batch_count);
}

class Motion : public BatchFixture {
protected:
    void set_up_sphere(const pt_sphere &sphere, double shutter_open = 0, double shutter_close = 1) {
        const pt_material materials[] = {{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0},
                                         {{0.8F, 0.8F, 0.8F}, {0, 0, 0}, {0, 0, 0}, 0, 0}};
        const pt_plane plane{{0, 1, 0}, 1, 1, 0};
        const pt_scene scene = scene_of(materials, {&sphere, 1}, {&plane, 1});
        pt_camera camera = CourseworkScene::camera();
        camera.shutter_open = shutter_open;
        camera.shutter_close = shutter_close;
        set_up(scene, camera);
    }

    std::vector<float> image_of(const pt_render &render, uint32_t samples) {
        EXPECT_EQ(pt_set_render(context(), &render), PT_OK) << pt_last_error(context());
        accumulate(samples);
        std::vector<float> image(std::size_t{3} * render.width * render.height);
        readback(image);
        return image;
    }
};

constexpr uint32_t lamp_batches = 16;

struct FloorBall {
    double radius;
    double motion[3];
};

class HugeMotion : public Motion {
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
};

TEST_F(HugeMotion, InTheLimitOfNoneIsRest) {
    for (const double radius : {1e4, 1e7, 1e8, 1e12})
        for (const double length : {1e-9, 1e-6}) {
            set_up_floor({radius, {0, 0, 0}});
            const Estimate still = light(lamp_batches, 256);
            set_up_floor({radius, {length, 0, length}});
            const Estimate moving = light(lamp_batches, 256);
            const double error = std::hypot(still.standard_error, moving.standard_error, 1e-6 * still.mean);
            EXPECT_LT(std::abs(moving.mean - still.mean) / error, allowed_deviation(lamp_batches))
                << radius << ' ' << length;
        }
}

TEST_F(HugeMotion, OfALampTheOutsideIsSeen) {
    constexpr double radius = 1e6;
    const pt_material materials[] = {{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0}, {{0, 0, 0}, {0, 0, 0}, {4, 4, 4}, 0, 0}};
    const pt_sphere spheres[] = {{{0, -1e-3 - radius, 0}, radius, {1e3, 0, 0}, 0, 0}, {{0, 50, 0}, 5, {0, 0, 0}, 1, 0}};
    const pt_scene scene = scene_of(materials, spheres, {});
    set_up(scene, camera_at({0, 0, 0}, {0, 1, 0}, 0.1, {0, 0, 1}));
    for (const float value : image_of(render_of(8, 8, 1), 256))
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
        EXPECT_LT(std::abs(moving.mean - mean) / error, allowed_deviation(lamp_batches)) << floor.radius;
        // Negative control: the opposite vertical motion.
        set_up_floor({floor.radius, {floor.motion[0], -floor.motion[1], floor.motion[2]}});
        EXPECT_GT(std::abs(light(lamp_batches, 1024).mean - mean) / error, allowed_deviation(lamp_batches))
            << floor.radius;
    }
}

TEST_F(HugeMotion, IsRefusedWhereItIsTooLong) {
    const pt_render render = render_of(8, 8, 2);
    ASSERT_EQ(pt_set_render(context(), &render), PT_OK);
    const pt_accumulate_info info = accumulate_info(1);
    set_up_floor({1e7, {312499, 0, 0}});
    EXPECT_EQ(pt_accumulate(context(), &info), PT_OK) << pt_last_error(context());
    set_up_floor({1e7, {312501, 0, 0}});
    EXPECT_EQ(pt_accumulate(context(), &info), PT_ERROR_UNSUPPORTED);
    EXPECT_STREQ(pt_last_error(context()), "spheres[1].motion = (312501, 0, 0): must be less than a 32nd of the radius "
                                           "(1e+07) while the shutter is open, because the surface is nearer than a "
                                           "65536th of it to the camera");
    set_up_floor({1e7, {312501, 0, 0}}, 0.25, 0.5);
    EXPECT_EQ(pt_accumulate(context(), &info), PT_OK) << "while the shutter is open it moves less";
    set_up_floor({6e4, {1e6, 0, 0}});
    EXPECT_EQ(pt_accumulate(context(), &info), PT_OK) << "held by its center";
}

// Parallel views have no distance, so the rule uses the view's width.
TEST_F(HugeMotion, IsRefusedInNarrowParallelViews) {
    const pt_material shining{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0};
    const pt_sphere globe{{0, -1e7, 0}, 1e7, {1e6, 0, 0}, 0, 0};
    const pt_render render = render_of(8, 8, 1);
    for (const double height : {1.0, 1e3, 1e6}) {
        pt_camera camera = camera_at({0, height, 0}, {1e-3 * height, 0, 0}, 0.0, {0, 0, 1});
        camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
        camera.vertical_extent = 1e3;
        set_up(scene_of({&shining, 1}, {&globe, 1}, {}), camera);
        for (const float value : image_of(render, 4))
            EXPECT_EQ(value, 1.0F) << height;
        camera.vertical_extent = 10;
        ASSERT_EQ(pt_set_camera(context(), &camera), PT_OK) << pt_last_error(context());
        const pt_accumulate_info info = accumulate_info(1);
        EXPECT_EQ(pt_accumulate(context(), &info), PT_ERROR_UNSUPPORTED) << height;
        const std::string message = pt_last_error(context());
        EXPECT_TRUE(message.starts_with("spheres[0].motion = (1e+06, 0, 0): must be less than")) << message;
        EXPECT_NE(message.find("the start of parallel rays"), std::string::npos) << message;
    }
}

// All numbers are exact in binary.
TEST_F(Motion, ShutterIsTheSameAsRebasedMotion) {
    const pt_render render = render_of(64, 32, 2);
    set_up_sphere({{-2, 0.5, -6}, 0.5, {4, 0.5, 1}, 0, 0}, 0.25, 0.75);
    const std::vector<float> shutter = image_of(render, 64);
    set_up_sphere({{-1, 0.625, -5.75}, 0.5, {2, 0.25, 0.5}, 0, 0});
    EXPECT_EQ(image_of(render, 64), shutter);
    set_up_sphere({{-1, 0.625, -5.75}, 0.5, {2.06, 0.25, 0.5}, 0, 0});
    EXPECT_NE(image_of(render, 64), shutter) << "3% more speed must show";
    set_up_sphere({{-2, 0.5, -6}, 0.5, {4, 0.5, 1}, 0, 0}, 0.5, 0.5);
    const std::vector<float> closed = image_of(render, 64);
    EXPECT_FALSE(stats().features & PT_FEATURE_MOTION) << "nothing moves while the shutter is open";
    set_up_sphere({{0, 0.75, -5.5}, 0.5, {0, 0, 0}, 0, 0});
    EXPECT_EQ(image_of(render, 64), closed);
}

} // namespace
