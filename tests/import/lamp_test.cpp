// Lamps in the place of lights: what they give is looked up by integrating over them, in a scene of the test's own.
#include "cli/import/light_lamps.h"
#include "cli/import/view_target.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using cli::ForeignLamp;
using cli::ForeignLight;
using cli::ForeignScene;
using cli::ForeignVector;

ForeignScene lit_scene(const ForeignLight &light) {
    ForeignScene scene;
    scene.camera.position = {0, 0, 8};
    scene.lights = {light};
    return scene;
}

ForeignLamp only_lamp(const ForeignScene &scene) {
    std::vector<std::string> left_out;
    const std::vector<ForeignLamp> lamps = cli::lamps_of(scene, left_out);
    EXPECT_EQ(lamps.size(), 1U);
    EXPECT_TRUE(left_out.empty());
    return lamps.at(0);
}

// Of a surface at the origin that faces the lamp: over the cone of directions to it, cosine times radiance.
double irradiance(const ForeignLamp &lamp) {
    const double distance = std::hypot(lamp.center[0], lamp.center[1], lamp.center[2]);
    const double widest = std::asin(lamp.radius / distance);
    constexpr int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double angle = widest * (i + 0.5) / steps;
        sum += std::cos(angle) * std::sin(angle) * widest / steps;
    }
    return 2.0 * std::numbers::pi * lamp.emission[1] * sum;
}

TEST(LightLamp, LightsWhatIsLookedAtAsTheLightWould) {
    for (const double radius : {0.0, 0.25, 2.0}) {
        const ForeignLamp lamp = only_lamp(lit_scene({"", false, {3, 4, 0}, {1, 0.5, 0}, {1, 0, 0}, radius}));
        EXPECT_NEAR(irradiance(lamp), std::numbers::pi * 0.5, 1e-8);
        EXPECT_EQ(lamp.radius, radius == 0.0 ? 0.1 : radius);
        EXPECT_EQ(lamp.emission[0], 2 * lamp.emission[1]);
    }
    const ForeignLamp faded = only_lamp(lit_scene({"", false, {3, 4, 0}, {1, 0.5, 0}, {1, 0.4, 0.04}, 0.0}));
    EXPECT_NEAR(irradiance(faded), std::numbers::pi * 0.5 / 4, 1e-8);
    const ForeignLamp sun = only_lamp(lit_scene({"", true, {0, 2, 0}, {1, 0.5, 0}}));
    EXPECT_NEAR(irradiance(sun), std::numbers::pi * 0.5, 1e-8);
    EXPECT_EQ(sun.center[1], 800.0);
}

TEST(LightLamp, TouchesNothing) {
    ForeignScene scene = lit_scene({"", false, {3, 4, 0}, {1, 1, 1}});
    scene.spheres = {{{3, 4, 2}, 1.9, 0}};
    EXPECT_NEAR(only_lamp(scene).radius, 0.05, 1e-12);
    scene.spheres[0].radius = 2.125; // it is inside
    EXPECT_NEAR(only_lamp(scene).radius, 0.0625, 1e-12);
    scene.planes = {{{0, 2, 0}, -7.9375, 0}};
    EXPECT_NEAR(only_lamp(scene).radius, 0.03125 / 2, 1e-12);
    EXPECT_NEAR(irradiance(only_lamp(scene)), std::numbers::pi, 1e-8);
}

TEST(LightLamp, IsHiddenUnlessTheFileHasItsSize) {
    ForeignScene scene = lit_scene({"", false, {0, 0, 8}, {1, 1, 1}}); // where the camera is
    EXPECT_TRUE(only_lamp(scene).is_hidden);
    EXPECT_EQ(only_lamp(scene).radius, 8.0 / 50);
    scene.lights[0].radius = 0.125;
    scene.camera.position[2] = 8.0625;
    EXPECT_FALSE(only_lamp(scene).is_hidden);
    EXPECT_EQ(only_lamp(scene).radius, 0.0625 / 2);
}

TEST(LightLamp, OnASurfaceIsLeftOut) {
    ForeignScene scene = lit_scene({"a.nff:7", false, {3, 4, 0}, {1, 1, 1}});
    scene.planes = {{{0, 1, 0}, -4, 0}};
    std::vector<std::string> left_out;
    EXPECT_TRUE(cli::lamps_of(scene, left_out).empty());
    EXPECT_EQ(left_out, std::vector<std::string>{"a.nff:7: the light lies on a surface, and is left out"});
    scene.lights[0].color = {};
    EXPECT_TRUE(cli::lamps_of(scene, left_out).empty());
    EXPECT_EQ(left_out.size(), 1U); // what is black is missed by nobody
}

TEST(LightLamp, AtWhatIsLookedAtIsMeasuredAtTheCamera) {
    const ForeignLamp lamp = only_lamp(lit_scene({"", false, {0, 0, 0}, {1, 1, 1}}));
    EXPECT_EQ(lamp.radius, 8.0 / 50);
    EXPECT_NEAR(lamp.emission[0], 2500, 1e-9);
}

TEST(ViewTarget, IsAmongWhatIsSeen) {
    ForeignScene scene;
    EXPECT_EQ(cli::view_target(scene, {1, 2, 3}, {0, 0, -5}), (ForeignVector{1, 2, 2}));
    scene.planes = {{{0, 0, 2}, -8, 0}, {{0, 0, 1}, 7, 0}, {{0, 1, 0}, 0, 0}}; // behind, in front, and beside
    EXPECT_EQ(cli::view_target(scene, {1, 2, 3}, {0, 0, -5}), (ForeignVector{1, 2, -7}));
    scene.spheres = {{{0, 0, 10}, 1, 0}};
    EXPECT_EQ(cli::view_target(scene, {1, 2, 3}, {0, 0, -5}), (ForeignVector{1, 2, -7}));
    scene.spheres = {{{0, 0, -4}, 1, 0}, {{0, 9, -1}, 2, 0}}; // z from -5 to 1
    EXPECT_EQ(cli::view_target(scene, {1, 2, 3}, {0, 0, -5}), (ForeignVector{1, 2, -2}));
}

} // namespace
