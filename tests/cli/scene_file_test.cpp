#include "cli/scene/scene.h"

#include "tests/cli/refusal_of.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <string>
#include <vector>

namespace {

using cli::parse_scene;
using cli::SceneFile;

std::string refusal(const std::string &text) {
    const Refusal refused = refusal_of([&] { parse_scene(text, "s.json"); });
    if (refused.message.empty())
        return "";
    EXPECT_EQ(refused.code, cli::ExitCode::scene);
    EXPECT_TRUE(refused.message.starts_with("s.json:")) << refused.message;
    return refused.message.substr(7);
}

template <typename Number, std::size_t Count>
std::vector<Number> list(const Number (&values)[Count]) {
    return {values, values + Count};
}

constexpr const char *small = R"({
  // Two materials, the second not used.
  "spheres": [ { "center": [1, 2, 3], "radius": 0.5, "material": "b", "motion": [0, 1, 0] },
               { "center": [4, 5, 6], "radius": 1, "material": "a" } ],
  "planes":  [ { "normal": [0, 1, 0], "offset": 4.5, "material": "b" } ],
  "materials": { "unused": {}, "b": { "diffuse": 0.25, "glossiness": 40, "hidden_from_camera": true },
                 "a": { "specular": [0.1, 0.2, 0.3], "emission": 7 } },
  "camera": { "position": [0, 0, 1], "look_at": [0, 0, -1], "up": [1, 0, 0], "vertical_fov": 90,
              "aperture": 0.125, "focus": 1.5, "shutter": [0.25, 0.5] },
  "film": { "width": 320, "height": 2e2, "exposure": -1.5, "tonemap": "agx", "gamma": 2.2, "white": [1, 2, 0.5] },
  "render": { "max_path_length": 3, "spp": 16, "seed": 18446744073709551615, "sampler": "halton-cp",
              "estimator": "uniform" }
})";

TEST(SceneFile, SpheresMayHaveColors) {
    const auto sphere = [](const std::string &rest) {
        return R"({"center": [1, 2, 3], "radius": 1, "material": "a")" + rest + "}";
    };
    const std::string rest = R"("materials": {"a": {}}})";
    const SceneFile plain = parse_scene("{\"spheres\": [" + sphere("") + "]," + rest, "s.json");
    EXPECT_EQ(plain.scene().sphere_count, 1U);
    EXPECT_TRUE(plain.sphere_arrays().empty());

    const std::string text = "{\"spheres\": [" + sphere("") + ",\n" + sphere(R"(, "color": [0.5, 0, 1])") + ",\n" +
                             sphere("") + ",\n" + sphere(R"(, "color": 0.25)") + "]," + rest;
    const SceneFile scene = parse_scene(text, "s.json");
    EXPECT_EQ(scene.scene().sphere_count, 0U);
    ASSERT_EQ(scene.sphere_arrays().size(), 1U);
    EXPECT_EQ(scene.sphere_arrays()[0].count, 4U);
    const std::array<std::array<float, 3>, 4> colors{{{1, 1, 1}, {0.5F, 0, 1}, {1, 1, 1}, {0.25F, 0.25F, 0.25F}}};
    for (std::size_t i = 0; i < colors.size(); ++i)
        EXPECT_EQ(scene.sphere_items.items[i].color, colors[i]) << i;
    EXPECT_EQ(scene.sphere_arrays()[0].opacity.data, nullptr);
    const SceneFile passed =
        parse_scene("{\"spheres\": [" + sphere("") + "," + sphere(R"(, "opacity": 0.5)") + "]," + rest, "s.json");
    EXPECT_EQ(passed.sphere_items.items[0].opacity[0], 1.0F);
    EXPECT_EQ(passed.sphere_items.items[1].opacity[0], 0.5F);
    EXPECT_EQ(passed.sphere_arrays()[0].opacity.data, &passed.sphere_items.items[0].opacity);
    cli::BrokenRule rule{"sphere_arrays", 0, "color", 3, "", "2", "must lie in [0, 1]"};
    EXPECT_EQ(scene.explain(rule), "s.json:4: spheres[3].color = 2: must lie in [0, 1]");
}

TEST(SceneFile, ReadsEverything) {
    const SceneFile scene = parse_scene(small, "s.json");
    EXPECT_EQ(scene.material_names, (std::vector<std::string>{"unused", "b", "a"}));
    ASSERT_EQ(scene.materials.size(), 3U);
    EXPECT_EQ(list(scene.materials[0].diffuse), (std::vector<float>{0, 0, 0}));
    EXPECT_EQ(list(scene.materials[1].diffuse), (std::vector<float>{0.25F, 0.25F, 0.25F}));
    EXPECT_EQ(scene.materials[1].glossiness, 40.0F);
    EXPECT_EQ(list(scene.materials[2].specular), (std::vector<float>{0.1F, 0.2F, 0.3F}));
    EXPECT_EQ(scene.materials[0].flags, 0U);
    EXPECT_EQ(scene.materials[1].flags, std::uint32_t{PT_MATERIAL_HIDDEN_FROM_CAMERA});
    EXPECT_EQ(list(scene.materials[2].emission), (std::vector<float>{7, 7, 7}));
    ASSERT_EQ(scene.spheres.size(), 2U);
    EXPECT_EQ(list(scene.spheres[0].center), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(scene.spheres[0].radius, 0.5);
    EXPECT_EQ(list(scene.spheres[0].motion), (std::vector<double>{0, 1, 0}));
    EXPECT_EQ(scene.spheres[0].material, 1U);
    EXPECT_EQ(list(scene.spheres[1].motion), (std::vector<double>{0, 0, 0}));
    EXPECT_EQ(scene.spheres[1].material, 2U);
    ASSERT_EQ(scene.planes.size(), 1U);
    EXPECT_EQ(list(scene.planes[0].normal), (std::vector<double>{0, 1, 0}));
    EXPECT_EQ(scene.planes[0].offset, 4.5);
    EXPECT_EQ(scene.planes[0].material, 1U);
}

TEST(SceneFile, ReadsCameraAndSettings) {
    const SceneFile scene = parse_scene(small, "s.json");
    EXPECT_EQ(scene.camera.struct_size, sizeof(pt_camera));
    EXPECT_EQ(list(scene.camera.position), (std::vector<double>{0, 0, 1}));
    EXPECT_EQ(list(scene.camera.target), (std::vector<double>{0, 0, -1}));
    EXPECT_EQ(list(scene.camera.up), (std::vector<double>{1, 0, 0}));
    EXPECT_DOUBLE_EQ(scene.camera.vertical_fov, std::numbers::pi / 2.0);
    EXPECT_EQ(scene.camera.aperture, 0.125);
    EXPECT_EQ(scene.camera.focus, 1.5);
    EXPECT_EQ(scene.camera.shutter_open, 0.25);
    EXPECT_EQ(scene.camera.shutter_close, 0.5);
    EXPECT_EQ(scene.render.width, 320U);
    EXPECT_EQ(scene.render.height, 200U);
    EXPECT_EQ(scene.display.exposure, -1.5);
    EXPECT_EQ(scene.display.curve, std::uint32_t{PT_CURVE_AGX});
    EXPECT_EQ(scene.display.gamma, 2.2);
    EXPECT_EQ(std::to_array(scene.display.white), (std::array{1.0, 2.0, 0.5}));
    EXPECT_EQ(scene.render.max_path_length, 3U);
    EXPECT_EQ(scene.sample_count, 16U);
    EXPECT_EQ(scene.render.seed, 18446744073709551615U);
    EXPECT_EQ(scene.render.sampler, static_cast<std::uint32_t>(PT_SAMPLER_HALTON_CP));
    EXPECT_EQ(scene.render.estimator, static_cast<std::uint32_t>(PT_ESTIMATOR_UNIFORM));
}

TEST(SceneFile, EmptySceneHasDefaults) {
    const SceneFile scene = parse_scene("{}", "s.json");
    EXPECT_EQ(list(scene.camera.position), (std::vector<double>{0, 0, 1}));
    EXPECT_EQ(list(scene.camera.target), (std::vector<double>{0, 0, 0}));
    EXPECT_EQ(scene.camera.vertical_fov, 0.0);
    EXPECT_EQ(scene.camera.shutter_close, 1.0);
    EXPECT_EQ(scene.render.struct_size, sizeof(pt_render));
    EXPECT_EQ(scene.render.width, 512U);
    EXPECT_EQ(scene.render.height, 512U);
    EXPECT_EQ(scene.render.max_path_length, 6U);
    EXPECT_EQ(scene.render.seed, 0U);
    EXPECT_FALSE(scene.sample_count || scene.display.gamma != 0.0);
    EXPECT_EQ(scene.display.automatic_exposure, 1U);
    const pt_scene view = scene.scene();
    EXPECT_EQ(view.struct_size, sizeof(pt_scene));
    EXPECT_EQ(view.sphere_count, 0U);
}

TEST(SceneFile, AShutterMayBeAnInstant) {
    const auto camera = [](const std::string &shutter) {
        return parse_scene(R"({"camera":{"position":[0,0,0],"look_at":[0,0,1],"shutter":)" + shutter + "}}", "").camera;
    };
    EXPECT_EQ(camera("[0, 0]").shutter_open, 0.0);
    EXPECT_EQ(camera("[0, 0]").shutter_close, 0.0);
    EXPECT_EQ(camera("[-0.0, 0.0]").shutter_close, 0.0);
}

TEST(SceneFile, ExposuresAreNumbersOrAutomatic) {
    EXPECT_EQ(parse_scene(R"({"film":{"exposure":"auto"}})", "").display.automatic_exposure, 1U);
    EXPECT_EQ(parse_scene(R"({"film":{"exposure":3}})", "").display.exposure, 3.0);
    for (const char *exposure : {"65", "\"1\"", "\"bright\"", "null"}) {
        EXPECT_EQ(refusal(std::string(R"({"film":{"exposure":)") + exposure + "}}"),
                  std::string("1: film.exposure: must be a number from -64 to 64 stops, or \"auto\", is ") + exposure);
    }
    EXPECT_EQ(refusal(R"({"film":{"gamma":0}})"), "1: film.gamma: must be a number from 0.1 to 10, is 0");
    EXPECT_EQ(refusal(R"({"film":{"white":[1,0,1]}})"), "1: film.white[1]: must be a number from 0.001 to 1000, is 0");
}

TEST(SceneFile, SyntaxErrorsHaveLineAndColumn) {
    EXPECT_TRUE(refusal("").starts_with("1:1: syntax error"));
    EXPECT_TRUE(refusal("{\n  \"film\": NaN\n}").starts_with("2:11: syntax error"));
    EXPECT_TRUE(refusal("{\n\n\"film\" {}}").starts_with("3:8: syntax error"));
    EXPECT_TRUE(refusal("{} {}").starts_with("1:4: syntax error"));
    EXPECT_TRUE(refusal("{\"film\": {\"width\": 1,}}").starts_with("1:22: syntax error"));
    EXPECT_TRUE(refusal("{\"film\": \"\xff\"}").starts_with("1:11: syntax error"));
    EXPECT_TRUE(refusal("{\"film\": {").starts_with("1:11: syntax error"));
    EXPECT_TRUE(refusal("{\n").starts_with("2:1: syntax error"));
}

TEST(SceneFile, AMissingCommaIsToldWhereItBelongs) {
    const std::string missing = "syntax error: a comma is missing";
    EXPECT_EQ(refusal("{\"film\": {\n\"width\": 4\n  \"height\": 2}}"), "2:11: " + missing);
    EXPECT_EQ(refusal("{\"film\": {\n\"tonemap\": \"agx\" // a remark\n  \"height\": 2}}"), "2:17: " + missing);
    EXPECT_EQ(refusal("{\"film\": {}\n\n\"render\": {}}"), "1:12: " + missing);
    EXPECT_EQ(refusal("{\"spheres\": [{}\n{}]}").substr(0, 3), "1: ");
    EXPECT_EQ(refusal("{\"camera\": {\"position\": [1, 2\n3]}}"), "1:30: " + missing);
    EXPECT_EQ(refusal("{\"camera\": {\"position\": [1, [2]\ntrue]}}"), "1:32: " + missing);
    EXPECT_NE(refusal("{\"film\": {\"width\": 4 x}}").find("invalid literal"), std::string::npos);
    EXPECT_EQ(refusal("{\"film\": {\"width\": 4]}").find(missing), std::string::npos);
    EXPECT_EQ(refusal("{\"film\": {\"width\" 4}}").find(missing), std::string::npos);
    EXPECT_EQ(refusal("{\"film\": {}} {}").find(missing), std::string::npos);
}

TEST(SceneFile, DeepNestingIsNotDangerous) {
    constexpr std::size_t depth = 100'000;
    const std::string open(depth, '[');
    const std::string close(depth, ']');
    EXPECT_EQ(refusal("{\"spheres\":[" + open + close + "]}"), "1: spheres[0]: must be an object, is an array");
    EXPECT_TRUE(refusal("{\"spheres\":[" + open).starts_with("1:100013: syntax error"));
}

TEST(SceneFile, WrongTypesAreNamed) {
    const auto sphere = [](const std::string &members) { return refusal("{\"spheres\":[{" + members + "}]}"); };
    EXPECT_EQ(refusal("[]"), "1: must contain an object, is an array");
    EXPECT_EQ(refusal("1"), "1: must contain an object, is a number");
    EXPECT_EQ(refusal(R"({"spheres":{}})"), "1: spheres: must be an array, is an object");
    EXPECT_EQ(refusal(R"({"materials":{"a":{"hidden_from_camera":1}}})"),
              "1: materials.a.hidden_from_camera: must be true or false, is 1");
    EXPECT_EQ(refusal(R"({"planes":[true]})"), "1: planes[0]: must be an object, is true");
    EXPECT_EQ(sphere(R"("center":[0,0,0],"radius":"two","material":"a")"),
              "1: spheres[0].radius: must be a number, is \"two\"");
    EXPECT_EQ(sphere(R"("center":[0,0],"radius":1,"material":"a")"),
              "1: spheres[0].center: must be an array of 3 numbers, has 2");
    EXPECT_EQ(sphere(R"("center":3,"radius":1,"material":"a")"),
              "1: spheres[0].center: must be an array of 3 numbers, is 3");
    EXPECT_EQ(sphere(R"("center":[0,null,0],"radius":1,"material":"a")"),
              "1: spheres[0].center[1]: must be a number, is null");
    EXPECT_EQ(sphere(R"("center":[0,0,0],"radius":1,"material":3)"), "1: spheres[0].material: must be a string, is 3");
    EXPECT_EQ(refusal(R"({"materials":{"a/b":{"diffuse":[1,2]}}})"),
              "1: materials[\"a/b\"].diffuse: must be a number or an array of 3 numbers, has 2");
    EXPECT_EQ(refusal(R"({"materials":{"a":{"glossiness":"0123456789012345678901234567890123456789"}}})"),
              "1: materials.a.glossiness: must be a number, is a string");
}

TEST(SceneFile, MissingMembersAreNamed) {
    EXPECT_EQ(refusal(R"({"spheres":[{"center":[0,0,0],"material":"a"}]})"), "1: spheres[0]: \"radius\" is missing");
    EXPECT_EQ(refusal(R"({"camera":{}})"), "1: camera: \"position\" is missing");
}

TEST(SceneFile, UnknownNamesGetASuggestion) {
    EXPECT_EQ(refusal(R"({"speres":[]})"), "1: unknown key \"speres\", did you mean \"spheres\"?");
    EXPECT_EQ(refusal(R"({"camera":{"lookat":[0,0,0]}})"),
              "1: camera: unknown key \"lookat\", did you mean \"look_at\"?");
    EXPECT_EQ(refusal(R"({"film":{"size":1}})"),
              "1: film: unknown key \"size\", known: width, height, exposure, tonemap, gamma, white");
    EXPECT_EQ(refusal(R"({"spheres":[{"raduis":1}]})"),
              "1: spheres[0]: unknown key \"raduis\", did you mean \"radius\"?");
    EXPECT_EQ(refusal(R"({"spheres":[{"center":[0,0,0],"radius":1,"material":"glod"}],"materials":{"gold":{}}})"),
              "1: spheres[0].material: unknown material \"glod\", did you mean \"gold\"?");
    EXPECT_EQ(refusal(R"({"render":{"sampler":"halton-pc"}})"),
              "1: render.sampler: unknown sampler \"halton-pc\", did you mean \"halton-cp\"?");
}

TEST(SceneFile, UnknownKeysHaveTheirOwnLine) {
    EXPECT_EQ(refusal("{\n\"film\": {},\n\"speres\": []}"), "3: unknown key \"speres\", did you mean \"spheres\"?");
    EXPECT_EQ(refusal("{\"film\": {\n\"widht\": 1}}"), "2: film: unknown key \"widht\", did you mean \"width\"?");
    EXPECT_EQ(refusal("{\"spheres\": [\n{\"center\": [0, 0, 0],\n\"raduis\": 1}]}"),
              "3: spheres[0]: unknown key \"raduis\", did you mean \"radius\"?");
}

TEST(SceneFile, NumbersAreShownAsTheyAreWritten) {
    for (const char *number : {"-3", "-300000", "-0.1", "1e+300", "-1234567.5"})
        EXPECT_EQ(refusal(std::string(R"({"film":{"gamma":)") + number + "}}"),
                  std::string("1: film.gamma: must be a number from 0.1 to 10, is ") + number);
}

TEST(SceneFile, DuplicatesAreRefused) {
    EXPECT_EQ(refusal(R"({"film":{},"film":{}})"), "1: film: is given twice");
    EXPECT_EQ(refusal(R"({"film":{"width":1,"width":1}})"), "1: film.width: is given twice");
    EXPECT_EQ(refusal(R"({"materials":{"a":{},"b":{},"a":{}}})"), "1: materials.a: is given twice");
    EXPECT_EQ(refusal(R"({"spheres":[{"radius":1,"radius":2}]})"), "1: spheres[0].radius: is given twice");
    EXPECT_EQ(refusal(R"({"materials":{"width":{}},"film":{"width":1}})"), "");
}

TEST(SceneFile, RefusalsHaveTheLineOfTheValue) {
    EXPECT_EQ(refusal("{\n\"film\": {\n\"width\":\n-1}}").substr(0, 14), "3: film.width:");
    EXPECT_EQ(refusal("{\n\"spheres\": [\n{},\n3]}"), "3: spheres[0]: \"center\" is missing");
    EXPECT_EQ(refusal("{\n\"film\": {\n\"width\": 1,\n\"width\": 2}}"), "4: film.width: is given twice");
    EXPECT_EQ(refusal("{\"planes\": [\n{\"normal\": [0,\n1e400\n]}]}"),
              "3: planes[0].normal[1]: the number 1e400 is too large");
    EXPECT_EQ(refusal("{\"spheres\": [\n{\"center\": [0, 0, 0], \"radius\": 1,\n\"material\": \"a\"}]}"),
              "3: spheres[0].material: unknown material \"a\"");
}

TEST(SceneFile, NumbersHaveLimits) {
    EXPECT_EQ(refusal(R"({"film":{"width":1e400}})"), "1: film.width: the number 1e400 is too large");
    EXPECT_EQ(refusal(R"({"materials":{"a":{"emission":1e39}}})"),
              "1: materials.a.emission: must lie in the range of 32-bit floating point numbers, is 1e+39");
    for (const char *width : {"-1", "1.5", "4294967296", "1e20", "\"1\""}) {
        EXPECT_TRUE(refusal(std::string(R"({"film":{"width":)") + width + "}}")
                        .starts_with("1: film.width: must be a whole number from 1 to 4294967295, is "))
            << width;
    }
    EXPECT_NE(refusal(R"({"render":{"seed":18446744073709551616}})"), "");
    EXPECT_NE(refusal(R"({"render":{"seed":-1}})"), "");
}

// In pt.h zero means the default.
TEST(SceneFile, ZerosAreNotDefaults) {
    const auto camera = [](const std::string &member) {
        return refusal(R"({"camera":{"position":[0,0,0],"look_at":[0,0,1],)" + member + "}}");
    };
    EXPECT_EQ(camera(R"("vertical_fov":0)"),
              "1: camera.vertical_fov: must be a number from 6e-07 to below 180 degrees, is 0");
    EXPECT_NE(camera(R"("vertical_fov":180)"), "");
    EXPECT_NE(camera(R"("vertical_fov":5e-7)"), ""); // 8.7e-9 radians is below the library's bound.
    EXPECT_EQ(camera(R"("vertical_fov":6e-7)"), "");
    EXPECT_EQ(camera(R"("vertical_fov":179.9)"), "");
    EXPECT_EQ(camera(R"("up":[0,0,0])"), "1: camera.up: must not be [0, 0, 0]");
    EXPECT_NE(refusal(R"({"render":{"max_path_length":0}})"), "");
    EXPECT_NE(refusal(R"({"render":{"spp":0}})"), "");
}

using cli::BrokenRule;
constexpr int none = -1;

TEST(SceneFile, ExplainsWhatTheLibraryRefuses) {
    const SceneFile scene = parse_scene(small, "s.json");
    const auto explained = [&](const BrokenRule &rule) { return scene.explain(rule); };
    EXPECT_EQ(explained({"spheres", 3, "radius", none, "", "-1", "must be > 0"}),
              "s.json:3: spheres[3].radius = -1: must be > 0");
    EXPECT_EQ(explained({"spheres", 1, "radius", none, "", "-1", "x"}), "s.json:4: spheres[1].radius = -1: x");
    EXPECT_EQ(explained({"materials", 2, "emission", 1, "", "-1", "x"}), "s.json:7: materials.a.emission[1] = -1: x");
    EXPECT_EQ(explained({"materials", 1, "glossiness", none, "", "-1", "must be >= 0"}),
              "s.json:6: materials.b.glossiness = -1: must be >= 0");
    EXPECT_EQ(explained({"camera", none, "target", 1, "", "inf", "must be finite"}),
              "s.json:8: camera.look_at[1] = inf: must be finite");
    EXPECT_EQ(explained({"camera", none, "position", 2, "", "inf", "x"}), "s.json:8: camera.position[2] = inf: x");
    EXPECT_EQ(explained({"render", none, "width", none, "* height", "5", "must be <= 4"}),
              "s.json:10: film.width * height = 5: must be <= 4");
    EXPECT_EQ(explained({"camera", none, "shutter_close", none, "", "2", "must be <= 1"}),
              "s.json:9: camera.shutter[1] = 2: must be <= 1");
    EXPECT_EQ(explained({"accumulate", none, "sample_count", none, "", "0", "y"}), "s.json:11: render.spp = 0: y");
    EXPECT_EQ(explained({"render", none, "estimator", none, "", "9", "x"}), "s.json:12: render.estimator = 9: x");
    EXPECT_EQ(explained({"materials", 99, "x", none, "", "0", "y"}), "s.json:6: materials[99].x = 0: y");
    EXPECT_EQ(explained({"create", none, "device", none, "", "7", "y"}), "s.json: create.device = 7: y");
    EXPECT_EQ(explained({"scene", none, "", none, "", "NULL", "y"}), "s.json: scene = NULL: y");
}

TEST(SceneFile, ExplainsWholeErrors) {
    const SceneFile scene = parse_scene(small, "s.json");
    EXPECT_EQ(explain(scene, cli::LibraryError{"out of everything", {}}), "s.json: out of everything");
    const cli::LibraryError error{"not read",
                                  {{"spheres", 3, "radius", none, "", "-1", "must be > 0"},
                                   {"materials", 2, "diffuse", 0, "", "-1", "must be >= 0"}},
                                  3};
    EXPECT_EQ(explain(scene, error), "s.json:3: spheres[3].radius = -1: must be > 0\n"
                                     "s.json:7: materials.a.diffuse[0] = -1: must be >= 0\n"
                                     "... and 3 more");
}

TEST(SceneFile, OnlyTextIsRead) {
    using namespace std::string_literals;
    EXPECT_EQ(refusal("{}\0{}"s), "1:3: a NUL byte: this is not UTF-8 text");
    EXPECT_EQ(refusal("{ // a remark\n \"film\": {\0} }"s), "2:11: a NUL byte: this is not UTF-8 text");
    EXPECT_EQ(refusal("{} // a remark \0"s), "1:16: a NUL byte: this is not UTF-8 text");
    EXPECT_EQ(refusal("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR"s), "3:1: a NUL byte: this is not UTF-8 text");
    EXPECT_EQ(refusal("\xff\xfe{\0"s), "1:4: a NUL byte: this is not UTF-8 text"); // UTF-16
    EXPECT_EQ(refusal("\0\1\0\0"s), "1:1: a NUL byte: this is not UTF-8 text");
}

TEST(SceneFile, AByteOrderMarkOfUtf8DoesNoHarm) {
    EXPECT_EQ(parse_scene("\xef\xbb\xbf" + std::string(small), "s.json").spheres.size(), 2U);
    EXPECT_TRUE(refusal("\xef\xbb\xbf{,").starts_with("1:2: syntax error")) << refusal("\xef\xbb\xbf{,");
}

// Reading in quadratic time would take minutes.
TEST(SceneFile, ManyItemsAreReadInLinearTime) {
    std::string text = "{\"materials\":{";
    constexpr int count = 30'000;
    for (int i = 0; i < count; ++i)
        text += (i == 0 ? "\"m" : ",\"m") + std::to_string(i) + "\":{}";
    text += "},\"spheres\":[";
    for (int i = 0; i < count; ++i) {
        text += (i == 0 ? "" : ",");
        text += R"({"center":[0,0,0],"radius":1,"material":"m)" + std::to_string(count - 1 - i) + "\"}";
    }
    const SceneFile scene = parse_scene(text + "]}", "s.json");
    ASSERT_EQ(scene.spheres.size(), std::size_t{count});
    EXPECT_EQ(scene.spheres.front().material, std::uint32_t{count - 1});
    EXPECT_EQ(scene.spheres.back().material, 0U);
}

} // namespace
