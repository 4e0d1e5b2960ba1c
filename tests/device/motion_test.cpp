// Moving spheres and lamps through pt.h: coverage in closed form, frozen times, the shutter's interval. Run alone with
// --gtest_filter=Motion*.
#include "tests/device/floor_radiance.h"
#include "tests/support/batch_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace {

// One false alarm in a million for the file: each comparison has its share of that.
constexpr double motion_comparisons = 200;
double allowed_deviation(std::size_t batch_count) {
    return student_bound(1e-6 / motion_comparisons, batch_count);
}

class Motion : public BatchFixture {
protected:
    // One sphere, and a floor if it is not black.
    void set_up_sphere(const pt_sphere &sphere, float radiance, float floor_albedo, double shutter_open = 0,
                       double shutter_close = 1) {
        const pt_material materials[] = {{{0, 0, 0}, {0, 0, 0}, {radiance, radiance, radiance}, 0, 0},
                                         {{floor_albedo, floor_albedo, floor_albedo}, {0, 0, 0}, {0, 0, 0}, 0, 0}};
        const pt_plane plane{{0, 1, 0}, 1, 1, 0};
        const pt_scene scene = scene_of(materials, {&sphere, 1}, {&plane, floor_albedo > 0 ? 1U : 0U});
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

// ---- A moving disc -------------------------------------------------------------------------------------------------

// Share of time and place in a pixel of 64 x 32 for which the sphere covers it: exact integrals over time (the
// interval in which a direction meets the sphere), quadrature over the pixel.
struct Covered {
    uint32_t column;
    uint32_t row;
    double share;
};
constexpr Covered covered[] = {{32, 15, 0.21104518863645677},
                               {25, 16, 0.20613988318813664},
                               {40, 13, 0.16340025309692244},
                               {32, 13, 0.2288268137895585}};

pt_sphere moving_disc(double speed) {
    return {{-2, 0.1, -6}, 0.5, {4 * speed, 0.5 * speed, 0}, 0, 0};
}

constexpr uint32_t disc_batches = 16;

double worst_coverage(const Batches &batches) {
    double worst = 0.0;
    for (const Covered &pixel : covered)
        worst = std::max(worst,
                         std::abs(deviation(estimate_of_pixel(batches, 64 * pixel.row + pixel.column), pixel.share)));
    return worst;
}

TEST_F(Motion, DiscCoversTheExactShare) {
    for (const uint32_t sampler : {PT_SAMPLER_RANDOM, PT_SAMPLER_HALTON_CP, PT_SAMPLER_SOBOL}) {
        set_up_sphere(moving_disc(1), 1, 0);
        pt_render render = render_of(64, 32, 1);
        render.sampler = sampler;
        const Batches batches = render_batches(render, disc_batches, 512);
        EXPECT_LT(worst_coverage(batches), allowed_deviation(disc_batches)) << "sampler " << sampler;
        EXPECT_TRUE(stats().features & PT_FEATURE_MOTION);
    }
    // Negative control: 3% more speed leaves 3% less time in each pixel.
    set_up_sphere(moving_disc(1.03), 1, 0);
    const Batches batches = render_batches(render_of(64, 32, 1), disc_batches, 512);
    EXPECT_GT(worst_coverage(batches), allowed_deviation(disc_batches));
}

// Plain Halton has no seed, so its error is bounded as a quadrature: 1024 points in base 2 by 3 by 5 of an indicator
// whose boundary crosses the cells of 4096 points: the random error sqrt(p (1 - p) / n) bounds it from above.
TEST_F(Motion, HaltonCoversTheExactShare) {
    set_up_sphere(moving_disc(1), 1, 0);
    pt_render render = render_of(64, 32, 1);
    render.sampler = PT_SAMPLER_HALTON;
    const std::vector<float> image = image_of(render, 4096);
    for (const Covered &pixel : covered) {
        const double random_error = std::sqrt(pixel.share * (1.0 - pixel.share) / 4096);
        EXPECT_NEAR(image[3 * (64 * pixel.row + pixel.column)], pixel.share, random_error);
    }
}

// ---- A moving lamp -------------------------------------------------------------------------------------------------

const FloorLamp moving_lamp{{-3, 2, -5}, 0.3, 50, {6, 0, 0}};

pt_sphere lamp_sphere(const FloorLamp &lamp, double speed = 1) {
    return {{lamp.centre.x, lamp.centre.y, lamp.centre.z},
            lamp.radius,
            {speed * lamp.motion.x, speed * lamp.motion.y, speed * lamp.motion.z},
            0,
            0};
}

constexpr uint32_t lamp_batches = 16;
constexpr uint32_t lamp_samples = 1024;
constexpr std::size_t floor_pixels[] = {16 * 5 + 3, 16 * 6, 16 * 6 + 8, 16 * 7 + 2, 16 * 7 + 15}; // of 16 x 8

double expected_on_floor(std::size_t pixel, const FloorLamp &lamp) {
    return floor_radiance(std::span(&lamp, 1), 16, 8, static_cast<uint32_t>(pixel % 16),
                          static_cast<uint32_t>(pixel / 16));
}

// The closed form against values that were found independently, by quadrature and by a double precision path tracer.
TEST(MotionClosedForm, MatchesTabulatedPixels) {
    const auto at = [](uint32_t column, uint32_t row) {
        return floor_radiance(std::span(&moving_lamp, 1), 256, 128, column, row, 32);
    };
    EXPECT_NEAR(at(128, 127) / 0.07460178420449085, 1.0, 1e-7);
    EXPECT_NEAR(at(150, 90) / 0.22958214706016572, 1.0, 1e-7);
    EXPECT_NEAR(at(40, 100) / 0.11394761213142683, 1.0, 1e-7);
}

TEST_F(Motion, LampLightsTheFloorAsInClosedForm) {
    for (const uint32_t estimator : {PT_ESTIMATOR_LIGHT, PT_ESTIMATOR_MIS})
        for (const uint32_t sampler : {PT_SAMPLER_RANDOM, PT_SAMPLER_SOBOL}) {
            pt_render render = render_of(16, 8, 2);
            render.estimator = estimator;
            render.sampler = sampler;
            set_up_sphere(lamp_sphere(moving_lamp), 50, 0.8F);
            const Batches batches = render_batches(render, lamp_batches, lamp_samples);
            for (const std::size_t pixel : floor_pixels)
                EXPECT_LT(std::abs(deviation(estimate_of_pixel(batches, pixel), expected_on_floor(pixel, moving_lamp))),
                          allowed_deviation(lamp_batches))
                    << "pixel " << pixel << " estimator " << estimator << " sampler " << sampler;
        }
    // Negative control: 3% more speed.
    set_up_sphere(lamp_sphere(moving_lamp, 1.03), 50, 0.8F);
    const Batches batches = render_batches(render_of(16, 8, 2), lamp_batches, lamp_samples);
    double worst = 0.0;
    for (const std::size_t pixel : floor_pixels)
        worst = std::max(worst,
                         std::abs(deviation(estimate_of_pixel(batches, pixel), expected_on_floor(pixel, moving_lamp))));
    EXPECT_GT(worst, allowed_deviation(lamp_batches));
}

// ---- A huge ball on the move ---------------------------------------------------------------------------------------

// The floor is a ball whose top is at the height -1, and moves.
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
        pt_camera camera{};
        camera.struct_size = sizeof camera;
        camera.shutter_close = 1;
        camera.target[0] = 0.3;
        camera.target[1] = -1;
        camera.target[2] = -0.4;
        camera.vertical_fov = 0.5;
        camera.shutter_open = shutter_open;
        camera.shutter_close = shutter_close;
        set_up(scene, camera);
    }

    // Of the whole image.
    Estimate light(uint32_t batch_count, uint32_t samples) {
        const Batches batches = render_batches(render_of(8, 8, 2), batch_count, samples);
        std::vector<std::size_t> pixels(batches.front().size());
        std::iota(pixels.begin(), pixels.end(), std::size_t{0});
        return estimate_over(batches, pixels);
    }
};

// However little it moves, it is where it is at rest.
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

// A lamp is held like a plane from a radius of 65536 distances on, whatever it moves: its inside is not seen.
TEST_F(HugeMotion, OfALampTheOutsideIsSeen) {
    constexpr double radius = 1e6;
    const pt_material materials[] = {{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0}, {{0, 0, 0}, {0, 0, 0}, {4, 4, 4}, 0, 0}};
    // Overhead another lamp fills the view; from within the floor none of it would be seen.
    const pt_sphere spheres[] = {{{0, -1e-3 - radius, 0}, radius, {1e3, 0, 0}, 0, 0}, {{0, 50, 0}, 5, {0, 0, 0}, 1, 0}};
    const pt_scene scene = scene_of(materials, spheres, {});
    pt_camera camera{};
    camera.struct_size = sizeof camera;
    camera.shutter_close = 1;
    camera.target[1] = 1;
    camera.up[2] = 1;
    camera.vertical_fov = 0.1;
    set_up(scene, camera);
    for (const float value : image_of(render_of(8, 8, 1), 256))
        EXPECT_EQ(value, 4.0F) << "the lamp overhead fills the view";
}

// By the midpoint rule over 32 instants: the light goes with height^-2 or so of a lamp 3 above, which
// changes by 1/4 of its value: an error of (1/4)^2 * 6 / 24 / 32^2 = 2e-5 of it at most.
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
        // Negative control: down instead of up.
        set_up_floor({floor.radius, {floor.motion[0], -floor.motion[1], floor.motion[2]}});
        EXPECT_GT(std::abs(light(lamp_batches, 1024).mean - mean) / error, allowed_deviation(lamp_batches))
            << floor.radius;
    }
}

TEST_F(HugeMotion, IsRefusedWhereItIsTooLong) {
    const pt_render render = render_of(8, 8, 2);
    ASSERT_EQ(pt_set_render(context(), &render), PT_OK);
    const pt_accumulate_info info{sizeof info, 1, nullptr, nullptr, 0, 0, 0, nullptr, 0, 0};
    set_up_floor({1e7, {312499, 0, 0}});
    EXPECT_EQ(pt_accumulate(context(), &info), PT_OK) << pt_last_error(context());
    set_up_floor({1e7, {312501, 0, 0}});
    EXPECT_EQ(pt_accumulate(context(), &info), PT_ERROR_UNSUPPORTED);
    EXPECT_STREQ(pt_last_error(context()), "spheres[1].motion = (312501, 0, 0): a sphere whose surface, as the shutter "
                                           "opens, is nearer to the camera than a 65536th of its "
                                           "radius (1e+07) must move less than a 32nd of it while the shutter is open");
    set_up_floor({1e7, {312501, 0, 0}}, 0.25, 0.5);
    EXPECT_EQ(pt_accumulate(context(), &info), PT_OK) << "while the shutter is open it moves less";
    set_up_floor({6e4, {1e6, 0, 0}});
    EXPECT_EQ(pt_accumulate(context(), &info), PT_OK) << "held by its centre";
}

// ---- The shutter ---------------------------------------------------------------------------------------------------

// All numbers are exact in binary, so that even the bits are equal.
TEST_F(Motion, ShutterIsTheSameAsRebasedMotion) {
    const pt_render render = render_of(64, 32, 2);
    set_up_sphere({{-2, 0.5, -6}, 0.5, {4, 0.5, 1}, 0, 0}, 1, 0.8F, 0.25, 0.75);
    const std::vector<float> shutter = image_of(render, 64);
    set_up_sphere({{-1, 0.625, -5.75}, 0.5, {2, 0.25, 0.5}, 0, 0}, 1, 0.8F);
    EXPECT_EQ(image_of(render, 64), shutter);
    set_up_sphere({{-1, 0.625, -5.75}, 0.5, {2.06, 0.25, 0.5}, 0, 0}, 1, 0.8F);
    EXPECT_NE(image_of(render, 64), shutter) << "3% more speed must show";
    set_up_sphere({{-2, 0.5, -6}, 0.5, {4, 0.5, 1}, 0, 0}, 1, 0.8F, 0.5, 0.5);
    const std::vector<float> closed = image_of(render, 64);
    EXPECT_FALSE(stats().features & PT_FEATURE_MOTION) << "nothing moves while the shutter is open";
    set_up_sphere({{0, 0.75, -5.5}, 0.5, {0, 0, 0}, 0, 0}, 1, 0.8F);
    EXPECT_EQ(image_of(render, 64), closed);
}

} // namespace
