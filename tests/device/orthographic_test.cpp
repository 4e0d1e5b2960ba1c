// Parallel camera rays, through pt.h, against what they see exactly. Run alone with --gtest_filter=Orthographic*.
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"

#include <pt/stats.h>

#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace orthographic {

namespace {

constexpr std::uint32_t picture_width = 32;
constexpr std::uint32_t picture_height = 24;
constexpr std::uint32_t sample_count = 256;
constexpr double extent = 6.0; // of the view's height, so that its width is 8

const std::vector<pt_material> materials = {{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0},
                                            {{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {0, 0, 0}, 0, 0},
                                            {{0, 0, 0}, {0, 0, 0}, {64, 64, 64}, 0, 0}};

// Towards the origin, from as far away.
pt_camera camera_from(double distance) {
    pt_camera camera{};
    camera.struct_size = sizeof camera;
    camera.shutter_close = 1;
    camera.position[0] = 0.48 * distance;
    camera.position[1] = 0.6 * distance;
    camera.position[2] = 0.64 * distance;
    camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    camera.vertical_extent = extent;
    return camera;
}

class Orthographic : public ContextFixture {
protected:
    void set(std::span<const pt_sphere> spheres, std::span<const pt_plane> planes, const pt_camera &camera,
             std::uint32_t max_path_length, std::uint32_t first_sample = 0) {
        const pt_scene scene = scene_of(materials, spheres, planes);
        pt_render render = render_of(picture_width, picture_height, max_path_length);
        render.first_sample = first_sample;
        set_picture(context(), scene, camera, render);
    }

    std::vector<float> read(std::uint32_t quantity) {
        return values_of(context(), std::size_t{picture_width} * picture_height, quantity);
    }

    // Mean over the image.
    double mean(std::uint32_t quantity) {
        const std::vector<float> values = read(quantity);
        double sum = 0.0;
        for (const float value : values)
            sum += value;
        return sum / static_cast<double>(values.size());
    }

    // What the view has of a silhouette's area is at most one random sample of share p off by each: with independent
    // points its standard error is sqrt(p (1 - p) / n), and those of a sequence are better.
    void expect_area(double area, const std::string &what) {
        const double share = area / (extent * extent * picture_width / picture_height);
        const double samples = double{picture_width} * picture_height * sample_count;
        const double error = std::sqrt(share * (1.0 - share) / samples);
        EXPECT_NEAR(mean(PT_QUANTITY_COVERAGE), share, 4.0 * error) << what;
        EXPECT_NEAR(mean(PT_QUANTITY_RADIANCE), share, 4.0 * error) << what;
    }
};

TEST_F(Orthographic, ABallIsADiscOfItsRadiusAtAnyDepth) {
    for (const double distance : {4.0, 1e3, 1e6, 1e9})
        for (const double depth : {-1.0, 0.0, 1.0}) {
            const pt_camera camera = camera_from(distance);
            const pt_sphere ball{{0.48 * depth, 0.6 * depth, 0.64 * depth}, 2, {0, 0, 0}, 0, 0};
            set({&ball, 1}, {}, camera, 1);
            accumulate(sample_count);
            expect_area(std::numbers::pi * 4.0, std::to_string(distance) + ", " + std::to_string(depth));
        }
    EXPECT_TRUE(stats().features & PT_FEATURE_ORTHOGRAPHIC);
}

// Behind the plane on which rays start nothing is seen, and in a ball its inside is.
TEST_F(Orthographic, RaysStartOnThePlaneThroughThePosition) {
    pt_camera camera{};
    camera.struct_size = sizeof camera;
    camera.shutter_close = 1;
    camera.target[2] = -1;
    camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    camera.vertical_extent = extent;
    const pt_sphere behind{{0, 0, 2.5}, 2, {0, 0, 0}, 0, 0};
    set({&behind, 1}, {}, camera, 1);
    accumulate(4);
    EXPECT_EQ(mean(PT_QUANTITY_COVERAGE), 0.0);
    const pt_sphere cut{{0, 0, 1}, 2, {0, 0, 0}, 0, 0};
    set({&cut, 1}, {}, camera, 1);
    accumulate(sample_count);
    expect_area(std::numbers::pi * 3.0, "a ball of which a disc of radius sqrt(3) is on the plane");
}

// Of a ball that moves across the view by less than its diameter the share is the same, wherever it is.
TEST_F(Orthographic, ABallThatMovesCoversAsMuch) {
    const pt_camera camera = camera_from(1e6);
    const pt_sphere ball{{-0.4, 0, 0.3}, 1.5, {0.8, 0, -0.6}, 0, 0};
    set({&ball, 1}, {}, camera, 1);
    accumulate(sample_count);
    expect_area(std::numbers::pi * 2.25, "while it moves");
    EXPECT_TRUE(stats().features & PT_FEATURE_MOTION);
}

// A lamp of radius r and radiance L far above a floor, at a height h, gives the point below it pi L (r / h)^2, and a
// point s beside it that times (1 + (s / h)^2)^-2, of which the floor's diffuse reflectance / pi is seen from any
// distance.
TEST_F(Orthographic, AFloorIsAsBrightFromAnyDistance) {
    const double height = 2000.0;
    const double radius = 250.0;
    const pt_sphere lamp{{0, height, 0}, radius, {0, 0, 0}, 2, 0};
    const pt_plane floor{{0, 1, 0}, 0, 1, 0};
    const double expected = 0.5 * 64.0 * radius * radius / (height * height);
    for (const double distance : {10.0, 1e3, 1e6}) {
        set({&lamp, 1}, {&floor, 1}, camera_from(distance), 2);
        accumulate(16);
        // The points that are seen are less than 8 from the lamp's foot: 2 (8 / 2000)^2 = 3.2e-5.
        EXPECT_NEAR(mean(PT_QUANTITY_RADIANCE) / expected, 1.0, 5e-5) << distance;
    }
}

// A globe that moves by more than a 32nd of its radius is held by its centre, to 2^-24 of the radius: good enough where
// the view is as wide as a 65536th of it, wherever its camera is, and else refused.
TEST_F(Orthographic, AGlobeThatMovesHasToBeSeenFromAfar) {
    const pt_sphere globe{{0, -1e7, 0}, 1e7, {1e6, 0, 0}, 0, 0};
    for (const double height : {1.0, 1e3, 1e6}) {
        pt_camera camera{};
        camera.struct_size = sizeof camera;
        camera.shutter_close = 1;
        camera.position[1] = height;
        camera.target[0] = 1e-3 * height;
        camera.up[2] = 1;
        camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
        camera.vertical_extent = 1e3;
        set({&globe, 1}, {}, camera, 1);
        accumulate(4);
        EXPECT_EQ(mean(PT_QUANTITY_COVERAGE), 1.0) << height;
        camera.vertical_extent = 10;
        set({&globe, 1}, {}, camera, 1);
        pt_accumulate_info info{};
        info.struct_size = sizeof info;
        info.sample_count = 1;
        ASSERT_EQ(pt_accumulate(context(), &info), PT_ERROR_UNSUPPORTED) << height;
        EXPECT_EQ(std::string(pt_last_error(context())).find("spheres[0].motion = (1e+06, 0, 0): a sphere whose"), 0U)
            << pt_last_error(context());
        EXPECT_NE(std::string(pt_last_error(context())).find("where parallel rays start"), std::string::npos);
    }
}

} // namespace

} // namespace orthographic
