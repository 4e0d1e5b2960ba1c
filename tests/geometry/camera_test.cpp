#include "lib/view/camera_rules.h"

#include "tests/geometry/refusals.h"
#include "tests/support/sized.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace {

constexpr double camera_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double camera_infinity = std::numeric_limits<double>::infinity();

pt_camera valid_camera() {
    auto camera = sized<pt_camera>();
    camera.position[2] = 1;
    return camera;
}

std::string camera_outcome(const pt_camera &camera) {
    return outcome_of(PT_ERROR_INVALID_ARGUMENT, [&] { pt::validated_camera(camera); });
}

void set(double (&to)[3], double x, double y, double z) {
    to[0] = x;
    to[1] = y;
    to[2] = z;
}

TEST(Camera, BrokenRulesAreNamed) {
    expect_refusals<pt_camera>(
        valid_camera(), camera_outcome,
        {{[](pt_camera &c) {
              c.projection = 2;
              c.position[1] = camera_nan;
              c.target[2] = -1e-20;
              c.up[0] = camera_nan;
              c.vertical_fov = 45;
              c.vertical_extent = 2;
              c.aperture = -0.5;
              c.focus = camera_infinity;
          },
          "camera.projection = 2: must be a PT_PROJECTION_*: 0 (perspective) or 1 (orthographic)\n"
          "camera.position[1] = nan: must be finite\n"
          "camera.target[2] = -1e-20: must be 0 or of a magnitude in [1e-18, 1e18]\n"
          "camera.up[0] = nan: must be finite\n"
          "camera.vertical_fov = 45: must lie in [1e-8, pi)\n"
          "camera.vertical_extent = 2: must be 0 with a perspective projection, which has a vertical_fov instead\n"
          "camera.aperture = -0.5: must be >= 0\n"
          "camera.focus = inf: must be finite"},
         {[](pt_camera &c) {
              c.projection = PT_PROJECTION_ORTHOGRAPHIC;
              c.vertical_extent = 1e19;
              c.vertical_fov = 1;
              c.aperture = 0.5;
              c.focus = camera_nan;
          },
          "camera.vertical_fov = 1: must be 0 with an orthographic projection, which has a vertical_extent instead\n"
          "camera.vertical_extent = 1e+19: must lie in [1e-18, 1e18]\n"
          "camera.aperture = 0.5: must be 0 with an orthographic projection, which has no lens\n"
          "camera.focus = nan: must be 0 with an orthographic projection, which has no lens"},
         {[](pt_camera &c) { set(c.target, 0, 0, 1); }, "camera.target = (0, 0, 1): must differ from position"},
         {[](pt_camera &c) { set(c.up, 0, 0x1p-27, 1); },
          "camera.up = (0, 7.450580596923828e-09, 1): must not be parallel to the viewing direction"},
         {[](pt_camera &c) { set(c.up, 0, 0, -1e300); },
          "camera.up = (0, 0, -1e+300): must not be parallel to the viewing direction"},
         {[](pt_camera &c) { set(c.target, 0, -5, 1); },
          "camera.up = (0, 1, 0): must not be parallel to the viewing direction"},
         {[](pt_camera &c) { c.vertical_fov = std::numbers::pi; },
          "camera.vertical_fov = 3.141592653589793: must lie in [1e-8, pi)"},
         {[](pt_camera &c) { c.vertical_fov = 9e-9; }, "camera.vertical_fov = 9e-09: must lie in [1e-8, pi)"},
         {[](pt_camera &c) { c.vertical_fov = camera_nan; }, "camera.vertical_fov = nan: must be finite"},
         {[](pt_camera &c) { c.shutter_open = camera_nan; }, "camera.shutter_open = nan: must be finite"},
         {[](pt_camera &c) { c.shutter_open = -0.25; }, "camera.shutter_open = -0.25: must be >= 0"},
         {[](pt_camera &c) { c.shutter_close = 1.5; }, "camera.shutter_close = 1.5: must be <= 1"},
         {[](pt_camera &c) { c.shutter_open = 0.5; }, "camera.shutter_close = 0: must be >= shutter_open (0.5)"},
         {[](pt_camera &c) { c.aperture = 2.5; }, "camera.aperture = 2.5: must be at most twice the focus (1)"}});
}

TEST(Camera, HasTheDefaultsOfTheHeader) {
    const pt::Camera camera = pt::validated_camera(valid_camera());
    EXPECT_EQ(camera.position, glm::dvec3(0, 0, 1));
    EXPECT_EQ(camera.forward, glm::dvec3(0, 0, -1));
    EXPECT_EQ(camera.right, glm::dvec3(1, 0, 0));
    EXPECT_EQ(camera.up, glm::dvec3(0, 1, 0));
    EXPECT_NEAR(camera.view_size, std::tan(std::numbers::pi / 8), 0x1p-41);
    EXPECT_EQ(camera.shutter_open, 0.0);
    EXPECT_EQ(camera.shutter_close, 0.0) << "the instant 0, in which nothing moves";
    EXPECT_FALSE(camera.has_lens());
}

// Tangents on different systems differ in the last bits.
TEST(Camera, IsTheSameWhereTangentsAreNearlySo) {
    pt_camera source = valid_camera();
    source.vertical_fov = 0.7;
    const std::string digest = digest_of(pt::validated_camera(source));
    source.vertical_fov = std::nextafter(0.7, 1.0);
    EXPECT_EQ(digest_of(pt::validated_camera(source)), digest);
    source.vertical_fov = 0.7 + 0x1p-36;
    EXPECT_NE(digest_of(pt::validated_camera(source)), digest);
}

TEST(Camera, MayHaveALens) {
    pt_camera source = valid_camera();
    const std::string pinhole = digest_of(pt::validated_camera(source));
    source.focus = 3;
    EXPECT_EQ(digest_of(pt::validated_camera(source)), pinhole);
    source.aperture = 0.5;
    const pt::Camera camera = pt::validated_camera(source);
    EXPECT_EQ(camera.lens_radius, 0.25);
    EXPECT_EQ(camera.focus, 3.0);
    EXPECT_NE(digest_of(camera), pinhole);
    source.focus = 0;
    EXPECT_EQ(pt::validated_camera(source).focus, 1.0) << "the target's distance";
}

TEST(Camera, AcceptsExtremes) {
    pt_camera camera = valid_camera();
    set(camera.position, 1e18, -1e18, 1e-18);
    set(camera.target, -1e18, 1e18, 0);
    set(camera.up, 0, 0, 1e-300);
    camera.vertical_fov = std::nextafter(std::numbers::pi, 0.0);
    camera.shutter_open = camera.shutter_close = 1;
    EXPECT_EQ(camera_outcome(camera), "accepted");
    camera.vertical_fov = 1e-8;
    EXPECT_EQ(camera_outcome(camera), "accepted");
    set(camera.position, 0, 0, 1e18);
    set(camera.target, 0, 0, std::nextafter(1e18, 0.0));
    set(camera.up, 0, 1e300, 0);
    EXPECT_EQ(camera_outcome(camera), "accepted");
}

} // namespace
