// Tests of cli/scene/scene_override: values in place of a scene file's.
#include "cli/scene/scene_override.h"

#include "cli/base/exit_code.h"
#include "cli/scene/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

namespace {

using cli::SceneFile;

constexpr const char *text = R"({
  "camera": { "position": [0, 0, 1], "look_at": [0, 0, -1] },
  "spheres": [ { "center": [1, 2, 3], "radius": 0.5, "material": "a" },
               { "center": [4, 5, 6], "radius": 1, "material": "b" } ],
  "materials": { "a": { "diffuse": [0.1, 0.2, 0.3] }, "b": {}, "blue = \"c\"]": {} }
})";

SceneFile changed(const std::vector<std::string> &settings, const char *scene = text) {
    std::vector<cli::SceneOverride> overrides;
    std::transform(settings.begin(), settings.end(), std::back_inserter(overrides), &cli::parse_override);
    return cli::parse_scene(scene, "s.json", overrides);
}

struct Refusal {
    int code;
    std::string message;
};

Refusal refusal_of(const std::vector<std::string> &settings, const char *scene = text) {
    try {
        changed(settings, scene);
    } catch (const cli::Failure &failure) {
        return {static_cast<int>(failure.code()), failure.what()};
    }
    return {0, ""};
}

TEST(SceneOverride, TakesThePlaceOfAValue) {
    EXPECT_EQ(changed({"spheres[1].radius=7"}).spheres[1].radius, 7.0);
    EXPECT_EQ(changed({"spheres[1].radius=7"}).spheres[0].radius, 0.5);
    EXPECT_EQ(changed({"spheres[0].center=[7, 8, 9]"}).spheres[0].center[2], 9.0);
    EXPECT_EQ(changed({"spheres[0].center[1]=-8e1"}).spheres[0].center[1], -80.0);
    EXPECT_EQ(changed({"spheres[0].center[1]=-8e1"}).spheres[0].center[2], 3.0);
    EXPECT_EQ(changed({"materials.a.diffuse=1"}).materials[0].diffuse[2], 1.0F);
    EXPECT_EQ(changed({"camera.position=[3,0,0]"}).camera.position[0], 3.0);
    EXPECT_EQ(changed({"spheres[0].radius=1", "spheres[0].radius=2"}).spheres[0].radius, 2.0); // the last
    const char *replaced = R"(spheres[0]={"center": [0,0,0], "radius": 3, "material": "b"})";
    EXPECT_EQ(changed({replaced, "spheres[0].radius=4"}).spheres[0].radius, 4.0);
    EXPECT_EQ(changed({replaced}).spheres[0].material, 1U);
}

TEST(SceneOverride, AddsMembers) {
    EXPECT_DOUBLE_EQ(changed({"camera.vertical_fov=90"}).camera.vertical_fov, std::numbers::pi / 2.0);
    EXPECT_EQ(changed({"film.width=64", "film.height=32"}).render.height, 32U); // in a section that is not there
    EXPECT_EQ(changed({"spheres[1].motion=[1,0,0]"}).spheres[1].motion[0], 1.0);
    const SceneFile scene = changed({"materials.new.emission=5", "spheres[0].material=new"});
    EXPECT_EQ(scene.materials.at(3).emission[0], 5.0F);
    EXPECT_EQ(scene.spheres[0].material, 3U);
    EXPECT_EQ(changed({"camera.position=[1,2,3]", "camera.look_at=[0,0,0]"}, "{}").camera.position[1], 2.0);
}

TEST(SceneOverride, TextsNeedNoQuotes) {
    EXPECT_EQ(changed({"film.tonemap=agx"}).display.curve, cli::ToneCurve::agx);
    EXPECT_EQ(changed({"film.tonemap=\"agx\""}).display.curve, cli::ToneCurve::agx);
    EXPECT_EQ(changed({R"(materials["blue = \"c\"]"].diffuse=0.5)"}).materials[2].diffuse[0], 0.5F);
}

TEST(SceneOverride, WhatIsNotAPathIsRefused) {
    for (const char *setting : {"", "camera", "camera=1", "camera.position", "=1", "camera.=1", "camera..x=1", "a.b",
                                "spheres[0=1", "spheres[-1].radius=1", "spheres[x].radius=1", "[\"a=1", ".camera.x=1",
                                "spheres[0]x=1", "spheres[99999999999999999999].radius=1"}) {
        const Refusal refused = refusal_of({setting});
        EXPECT_EQ(refused.code, 2) << setting;
        EXPECT_TRUE(refused.message.starts_with(std::string("--set ") + setting + ": must be a value within a section"))
            << refused.message;
    }
}

TEST(SceneOverride, WhatDoesNotFitIsRefused) {
    const auto expect = [](const std::string &setting, const std::string &reason, const char *scene = text) {
        const Refusal refused = refusal_of({setting}, scene);
        EXPECT_EQ(refused.code, 2) << setting;
        EXPECT_EQ(refused.message, "--set " + setting + ": " + reason);
    };
    expect("spheres[2].radius=1", "the scene has no spheres[2]");
    expect("planes[0].offset=1", "the scene has no planes[0]");
    expect("spheres[0].center[3]=1", "the scene has no spheres[0].center[3]");
    expect("spheres[0].radius.x=1", "the scene has no spheres[0].radius.x");
    expect("camera.fov=1", "camera: unknown key \"fov\", known: position, look_at, up, "
                           "projection, vertical_fov, vertical_extent, shutter");
    expect("camra.up=1", "unknown key \"camra\", did you mean \"camera\"?");
    expect("spheres.a=1", "must be an array, is an object");
    expect("spheres[0].radius=\"two\"", "spheres[0].radius: must be a number, is \"two\"");
    expect("spheres[0].radius=[1", "spheres[0].radius: must be a number, is \"[1\""); // which is no JSON
    expect("film.width=-1", "film.width: must be a whole number from 1 to 4294967295, is -1");
    expect("camera.up=[0,0]", "camera.up: must be an array of 3 numbers, has 2");
}

TEST(SceneOverride, MistakesOfTheFileAreItsOwn) {
    const Refusal refused = refusal_of({"film.height=2"}, "{\n\"film\": {\"width\": -1}}");
    EXPECT_EQ(refused.code, 3);
    EXPECT_TRUE(refused.message.starts_with("s.json:2: film.width: must be")) << refused.message;
    EXPECT_EQ(refusal_of({"film.width=1"}, "{\"film\": {\"width\": -1}}").code, 0); // mended
}

TEST(SceneOverride, TheLibrarysRulesLeadBackToIt) {
    const SceneFile scene = changed({"spheres[1].radius=-1"});
    const cli::BrokenRule of_option{"spheres", 1, "radius", std::nullopt, "", "-1", "must be > 0"};
    const cli::BrokenRule of_file{"spheres", 0, "radius", std::nullopt, "", "-1", "must be > 0"};
    EXPECT_EQ(scene.explain(of_option), "--set spheres[1].radius=-1: spheres[1].radius = -1: must be > 0");
    EXPECT_EQ(scene.blame(of_option), cli::ExitCode::usage);
    EXPECT_EQ(scene.explain(of_file), "s.json:3: spheres[0].radius = -1: must be > 0");
    EXPECT_EQ(scene.blame(of_file), cli::ExitCode::scene);
}

} // namespace
