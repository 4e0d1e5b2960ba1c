#include "cli/base/text.h"
#include "cli/render/render_options.h"
#include "cli/scene/scene.h"
#include "cli/scene/scene_options.h"
#include "lib/scene_file/scene_keys.h"
#include "tests/cli/refusal_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
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
    std::transform(settings.begin(), settings.end(), std::back_inserter(overrides),
                   [](const std::string &setting) { return pt::parse_override(setting, "--set "); });
    return cli::parse_scene(scene, "s.json", overrides);
}

Refusal refusal_of_settings(const std::vector<std::string> &settings, const char *scene = text) {
    return refusal_of([&] { changed(settings, scene); });
}

TEST(SceneOverride, TakesThePlaceOfAValue) {
    EXPECT_EQ(changed({"spheres[1].radius=7"}).spheres[1].radius, 7.0);
    EXPECT_EQ(changed({"spheres[0].center=[7, 8, 9]"}).spheres[0].center[2], 9.0);
    EXPECT_EQ(changed({"spheres[0].center[1]=-8e1"}).spheres[0].center[1], -80.0);
    EXPECT_EQ(changed({"materials.a.diffuse=1"}).materials[0].diffuse[2], 1.0F);
    EXPECT_EQ(changed({"spheres[0].radius=1", "spheres[0].radius=2"}).spheres[0].radius, 2.0);
    const char *replaced = R"(spheres[0]={"center": [0,0,0], "radius": 3, "material": "b"})";
    EXPECT_EQ(changed({replaced, "spheres[0].radius=4"}).spheres[0].radius, 4.0);
    EXPECT_EQ(changed({replaced}).spheres[0].material, 1U);
}

TEST(SceneOverride, AddsMembers) {
    EXPECT_DOUBLE_EQ(changed({"camera.vertical_fov=90"}).camera.vertical_fov, std::numbers::pi / 2.0);
    const SceneFile scene = changed({"materials.new.emission=5", "spheres[0].material=new"});
    EXPECT_EQ(scene.materials.at(3).emission[0], 5.0F);
    EXPECT_EQ(scene.spheres[0].material, 3U);
    EXPECT_EQ(changed({"camera.position=[1,2,3]", "camera.look_at=[0,0,0]"}, "{}").camera.position[1], 2.0);
}

TEST(SceneOverride, TextsNeedNoQuotes) {
    EXPECT_EQ(changed({"film.tonemap=agx"}).display.curve, std::uint32_t{PT_CURVE_AGX});
    EXPECT_EQ(changed({"film.tonemap=\"agx\""}).display.curve, std::uint32_t{PT_CURVE_AGX});
    EXPECT_EQ(changed({R"(materials["blue = \"c\"]"].diffuse=0.5)"}).materials[2].diffuse[0], 0.5F);
}

TEST(SceneOverride, WhatIsNotAPathIsRefused) {
    for (const char *setting : {"", "camera", "camera=1", "camera.position", "=1", "camera.=1", "camera..x=1", "a.b",
                                "spheres[0=1", "spheres[-1].radius=1", "spheres[x].radius=1", "[\"a=1", ".camera.x=1",
                                "spheres[0]x=1", "spheres[99999999999999999999].radius=1"}) {
        const Refusal refused = refusal_of_settings({setting});
        EXPECT_EQ(refused.code, cli::ExitCode::usage) << setting;
        EXPECT_TRUE(refused.message.starts_with(std::string("--set ") + setting + ": must be a value within a section"))
            << refused.message;
    }
}

TEST(SceneOverride, WhatDoesNotFitIsRefused) {
    const auto expect = [](const std::string &setting, const std::string &reason, const char *scene = text) {
        const Refusal refused = refusal_of_settings({setting}, scene);
        EXPECT_EQ(refused.code, cli::ExitCode::usage) << setting;
        EXPECT_EQ(refused.message, "--set " + setting + ": " + reason);
    };
    expect("spheres[2].radius=1", "the scene has no spheres[2]");
    expect("spheres[0].center[3]=1", "the scene has no spheres[0].center[3]");
    expect("spheres[0].radius.x=1", "the scene has no spheres[0].radius.x");
    expect("camra.up=1", "unknown key \"camra\", did you mean \"camera\"?");
    expect("spheres.a=1", "must be an array, is an object");
    expect("spheres[0].radius=[1", "spheres[0].radius: must be a number, is \"[1\"");
    expect("camera.up=[0,0]", "camera.up: must be an array of 3 numbers, has 2");
}

TEST(SceneOverride, MistakesOfTheFileStayMistakes) {
    const auto expect = [](const std::string &setting, const std::string &file, const std::string &reason) {
        const std::string alone = refusal_of_settings({}, file.c_str()).message;
        const Refusal refused = refusal_of_settings({setting}, file.c_str());
        EXPECT_EQ(refused.code, cli::ExitCode::scene) << setting;
        EXPECT_EQ(refused.message, "s.json:1: " + reason);
        EXPECT_EQ(refused.message, alone);
    };
    expect("spheres[0].radius=1", R"({"spheres": [{"center": [0, 0, 0], "radius": [1], "material": "a"}]})",
           "spheres[0].radius: must be a number, is an array");
    expect("materials.a.diffuse[0]=1", R"({"materials": {"a": {"diffuse": [1, 2]}}})",
           "materials.a.diffuse: must be a number or an array of 3 numbers, has 2");
    expect("animation[\"camera.up\"]=[[0, [0, 1, 0]]]", R"({"animation": {"camera.up": []}})",
           "animation[\"camera.up\"]: must be an array of key frames, [frame, value] each");
}

TEST(SceneOverride, EveryKeyWithAnOptionIsCheckedInTheFileToo) {
    int count = 0;
    for (const pt::SceneSection &section : pt::scene_sections()) {
        for (const pt::SceneKey &key : section.keys) {
            if (key.option.empty())
                continue;
            ++count;
            const std::string name = cli::concat(section.name, ".", key.name);
            const std::string file = cli::concat("{\"", section.name, "\": {\"", key.name, "\": []}}");
            const std::string value(key.rule.names.empty() ? "1" : key.rule.names[0]);
            const Refusal refused = refusal_of_settings({name + "=" + value}, file.c_str());
            EXPECT_EQ(refused.code, cli::ExitCode::scene) << name;
            EXPECT_TRUE(refused.message.starts_with("s.json:1: " + name + ": must be ")) << refused.message;
        }
    }
    EXPECT_GT(count, 7);
}

TEST(Animation, MistakesAreRefused) {
    const auto refusal = [](const std::string &members) -> std::string {
        const Refusal refused = refusal_of([&] { cli::parse_scene("{\"animation\": {" + members + "}}", "s.json"); });
        EXPECT_TRUE(refused.message.empty() || refused.code == cli::ExitCode::scene);
        return refused.message;
    };
    EXPECT_EQ(refusal(R"("camera.position": [[0, [1, 2, 3]]])"), "");
    for (const char *name :
         {"camera", "film.width", "render.seed", "camera.shutter", "spheres.center", "spheres[0]",
          "spheres[0].center[1]", "materials[0].diffuse", "camera.position=", "", "planes[0].", "x"}) {
        EXPECT_NE(refusal("\"" + std::string(name) + "\": [[0, 1]]").find("the name must be a key of the camera"),
                  std::string::npos)
            << name;
    }
    const std::pair<const char *, const char *> rows[] = {
        {"[]", ": must be an array of key frames, [frame, value] each"},
        {"{}", ": must be an array of key frames, [frame, value] each"},
        {"[0, [1, 2, 3]]", "[0]: must be [frame, value]"},
        {"[[0]]", "[0]: must be [frame, value]"},
        {"[[-1, 1]]", "[0][0]: must be a whole number from 0 to 4294967295, is -1"},
        {"[[0, \"a\"]]", "[0][1]: must be a number, is \"a\""},
        {"[[0, [1, null]]]", "[0][1][1]: must be a number, is null"},
        {"[[0, 1], [0, 2]]", "[1][0]: must be later than the previous key frame"},
        {"[[0, [1, 2]], [3, [1]]]", "[1][1]: must have as many numbers as the previous key frame"},
        {"[[0, [1]], [3, 1]]", "[1][1]: must have as many numbers as the previous key frame"}};
    for (const auto &[value, expected] : rows)
        EXPECT_EQ(refusal(std::string("\"camera.position\": ") + value),
                  std::string("s.json:1: animation[\"camera.position\"]") + expected);
}

TEST(FrameRange, IsReadFromText) {
    EXPECT_EQ(cli::parse_frames("5").value().last, 5U);
    EXPECT_EQ(cli::parse_frames("5-5").value().first, 5U);
    for (const char *text : {"", "-", "-3", "3-", "4-3", "a", "1-2-3", "1.5", "4294967296", " 1"})
        EXPECT_FALSE(cli::parse_frames(text)) << text;
    EXPECT_EQ(cli::numbered_name("f-##.png", 12345), "f-12345.png");
    EXPECT_EQ(cli::numbered_name("#1/###", 12), "#1/012");
}

} // namespace
