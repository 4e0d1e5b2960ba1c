// Opacities: shares of rays in closed form and beside a path tracer in double, and what no bit of the image depends on.
// Run alone with --gtest_filter=Opacity*.
#include "tests/support/light_in_double.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"

#include <pt/stats.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace opacity {

namespace {

using namespace light_in_double;

class Opacity : public LightInDouble {
protected:
    std::vector<float> image(const Given &given, std::uint32_t samples = 4) {
        return render_image(context(), given.scene(), given.camera, picture_of(PT_SAMPLER_SOBOL), samples);
    }
};

pt_camera camera_from(double distance, double vertical_fov) {
    pt_camera camera{};
    camera.struct_size = sizeof camera;
    camera.position[2] = distance;
    camera.up[1] = 1;
    camera.vertical_fov = vertical_fov;
    return camera;
}

// Rods and balls of any opacity about the origin, above a floor, and a lamp.
Given cloud(std::uint32_t count) {
    std::mt19937 engine(5);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 53>(engine);
    };
    Given given;
    given.camera = camera_from(8.0, 0.5);
    given.spheres.push_back({{3, 5, 1}, 1.5, {0, 0, 0}, 2, 0});
    for (std::uint32_t i = 0; i < count; ++i) {
        Given::Capsule each{{uniform(-2, 2), uniform(-1.2, 1.5), uniform(-2, 2)}, {0, 0, 0}, uniform(0.1, 0.5), i % 2};
        for (int axis = 0; axis < 3; ++axis)
            each.end[axis] = each.center[axis] + (i % 3 == 0 ? uniform(-0.5, 0.5) : 0.0);
        each.opacity = i % 5 == 0 ? 1.0F : static_cast<float>(uniform(0.0, 1.0));
        given.capsules.push_back(each);
    }
    return given;
}

// Black balls in a row before a sky of radiance 3, 4 and 5 leave the product of what each lets pass, and cover the
// rest. Of 98,304 rays the share is off by five standard errors, .008 at most, once in 1.7 million times. Negative
// control: in a row of opacities that are larger by 3% it is.
TEST_F(Opacity, IsTheShareOfRaysThatMeet) {
    const auto share_passed = [&](float first, float second) {
        Given given;
        given.materials[1].diffuse[0] = given.materials[1].diffuse[1] = given.materials[1].diffuse[2] = 0.0F;
        given.planes.clear();
        given.camera = camera_from(8.0, 0.05);
        given.capsules = {{{0, 0, 2}, {0, 0, 2}, 1.0, 1, first}, {{0, 0, -2}, {0, 0, -2}, 1.0, 1, second}};
        Given lit = given;
        lit.spheres = {{{0, 0, 0}, 50.0, {0, 0, 0}, 2, 0}};
        lit.materials[2].diffuse[0] = 0.0F;
        double passed = 0.0;
        const std::vector<float> radiance = image(lit, 256);
        for (std::size_t i = 0; i < radiance.size(); i += 3)
            passed += radiance[i] / (3.0 * picture.x * picture.y);
        EXPECT_EQ((stats().features & PT_FEATURE_OPACITY) != 0, std::min(first, second) < 1.0F);

        image(given, 256);
        std::vector<float> covered(std::size_t{3} * picture.x * picture.y);
        const pt_image target = image_target(covered, PT_QUANTITY_COVERAGE);
        EXPECT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
        double alpha = 0.0;
        for (const float share : covered)
            alpha += share / static_cast<double>(covered.size());
        EXPECT_NEAR(alpha, 1.0 - passed, 0.008);
        return passed;
    };
    EXPECT_NEAR(share_passed(0.4F, 0.2F), 0.48, 0.008);
    EXPECT_GT(std::abs(share_passed(0.412F, 0.206F) - 0.48), 0.008);
    EXPECT_NEAR(share_passed(0.6F, 0.0F), 0.4, 0.008);
    EXPECT_EQ(share_passed(1.0F, 0.5F), 0.0);
    EXPECT_NEAR(share_passed(0.0F, 0.0F), 1.0, 1e-6);
}

// Spheres about one centre, or apart along an axis by whole steps of a coarse or a fine grid, are met independently:
// two of opacity .5 let a fourth pass, to the same error.
TEST_F(Opacity, OfTwoSpheresIsIndependent) {
    const auto share_passed = [&](const glm::dvec3 &second, double radius, double extent) {
        Given given;
        given.materials[1].diffuse[0] = given.materials[1].diffuse[1] = given.materials[1].diffuse[2] = 0.0F;
        given.materials[2].diffuse[0] = 0.0F;
        given.planes.clear();
        given.camera = camera_from(8.0, 0.05);
        given.spheres = {{{0, 0, 0}, 100.0, {0, 0, 0}, 2, 0}};
        given.capsules = {{{0, 0, 1}, {0, 0, 1}, 1.0, 1, 0.5F},
                          {{second.x, second.y, second.z}, {second.x, second.y, second.z}, radius, 1, 0.5F},
                          {{extent, 0, 0}, {extent, 0, 0}, 1.0, 1, 0.0F}};
        double passed = 0.0;
        const std::vector<float> radiance = image(given, 256);
        for (std::size_t i = 0; i < radiance.size(); i += 3)
            passed += radiance[i] / (3.0 * picture.x * picture.y);
        return passed;
    };
    EXPECT_NEAR(share_passed({0, 0, 1}, 1.5, 4.0), 0.25, 0.008);
    for (double extent = 4.0; extent < 100.0; extent *= 2.0) {
        EXPECT_NEAR(share_passed({0, 0, -1}, 1.0, extent), 0.25, 0.008) << extent;
        EXPECT_NEAR(share_passed({0, 0.5, 1}, 1.0, extent), 0.25, 0.008) << extent;
        EXPECT_NEAR(share_passed({0.5, 0, 1}, 1.0, extent), 0.25, 0.008) << extent;
    }
}

// Shells in one another, one through the floor and one about the camera: paths are on both sides of each.
Given shells() {
    Given given = cloud(20);
    for (const auto &[height, radius] : {std::pair(0.0, 2.0), {0.0, 1.2}, {-1.5, 1.8}, {-0.5, 3.0}})
        given.capsules.push_back({{0.2, height, 0.1}, {0.2, height, 0.1}, radius, 1, 0.5F});
    given.capsules.push_back({{0, 0, 8}, {0, 0, 8}, 2.0, 0, 0.5F});
    return given;
}

// What is beyond an opaque plane stays there, though a sphere reaches through it.
TEST_F(Opacity, LeavesPlanesOpaque) {
    Given given = shells();
    given.spheres[0].center[1] = -4.0;
    const std::vector<float> radiance = image(given, 64);
    EXPECT_EQ(std::ranges::count(radiance, 0.0F), static_cast<std::ptrdiff_t>(radiance.size()));
}

// Negative control: opacities that are larger by a sixth are told from them.
TEST_F(Opacity, HasTheLightOfAPathTracerInDouble) {
    const Given given = shells();
    const Blocks exact = exact_blocks(given, 1200);
    EXPECT_LT(largest_error(given, exact, PT_SAMPLER_SOBOL), most_errors);
    Given denser = given;
    for (Given::Capsule &each : denser.capsules)
        each.opacity = std::min(each.opacity * 7.0F / 6.0F, 1.0F);
    EXPECT_GT(largest_error(denser, exact, PT_SAMPLER_SOBOL), most_errors);
}

// The order of the spheres, which is another tree, the scale, short submissions, and a device for each half.
TEST_F(Opacity, LeavesNoBitToChance) {
    const Given given = cloud(60);
    const std::vector<float> whole = image(given, 16);
    Given reversed = given;
    std::ranges::reverse(reversed.capsules);
    EXPECT_EQ(image(reversed, 16), whole);

    const Context hurried = create_context([](pt_create_info &info) { info.submit_milliseconds = 1; });
    const Context shared = create_context(
        [](pt_create_info &) {}, [](const auto *info, auto **made) { return create_shared(2, *info, made, true); });
    ASSERT_TRUE(hurried && shared);
    const pt_render render = picture_of(PT_SAMPLER_SOBOL);
    for (pt_context *const other : {hurried.get(), shared.get()})
        EXPECT_EQ(render_image(other, given.scene(), given.camera, render, 16), whole);

    Given large = given;
    for (Given::Capsule &each : large.capsules) {
        for (int axis = 0; axis < 3; ++axis) {
            each.center[axis] *= 0x1p20;
            each.end[axis] *= 0x1p20;
        }
        each.radius *= 0x1p20;
    }
    for (double &component : large.spheres[0].center)
        component *= 0x1p20;
    large.spheres[0].radius *= 0x1p20;
    large.planes[0].offset *= 0x1p20;
    large.camera.position[2] *= 0x1p20;
    EXPECT_EQ(image(large, 16), whole);
}

TEST_F(Opacity, IsRefusedWithTheReason) {
    Given given = cloud(6);
    const auto refusal = [&] {
        const pt_scene scene = given.scene();
        EXPECT_EQ(pt_set_scene(context(), &scene), PT_ERROR_INVALID_SCENE);
        return std::string(pt_last_error(context()));
    };
    given.capsules[4].opacity = 1.5F;
    EXPECT_NE(refusal().find("sphere_arrays[0].opacity[4] = 1.5: must lie in [0, 1]"), std::string::npos);
    given.capsules[4].opacity = 0.5F;
    given.capsules[1].opacity = 0.9F;
    given.materials[1].flags = PT_MATERIAL_HIDDEN_FROM_CAMERA;
    EXPECT_NE(
        refusal().find("sphere_arrays[0].material[1] = 1: must be of a material that neither emits nor is hidden"),
        std::string::npos);
}

} // namespace

} // namespace opacity
