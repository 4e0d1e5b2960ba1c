#include "cli/scene/scene.h"
#include "lib/scene_file/names.h"

#include "tests/cli/refusal_of.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

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

// Pictures of the shipped scenes see the other keys.
TEST(SceneFile, ReadsKeysThatNoShippedSceneHas) {
    const SceneFile scene = parse_scene(small, "s.json");
    EXPECT_EQ(scene.materials[0].flags, 0U);
    EXPECT_EQ(scene.materials[1].flags, std::uint32_t{PT_MATERIAL_HIDDEN_FROM_CAMERA});
    EXPECT_EQ(scene.camera.aperture, 0.125);
    EXPECT_EQ(scene.camera.focus, 1.5);
    EXPECT_EQ(scene.camera.shutter_open, 0.25);
    EXPECT_EQ(scene.camera.shutter_close, 0.5);
    EXPECT_EQ(scene.render.height, 200U);
    EXPECT_EQ(scene.render.sampler, std::uint32_t{PT_SAMPLER_HALTON_CP});
    EXPECT_EQ(scene.render.estimator, std::uint32_t{PT_ESTIMATOR_UNIFORM});
}

TEST(SceneFile, EmptySceneHasDefaults) {
    const SceneFile scene = parse_scene("{}", "s.json");
    EXPECT_EQ(std::to_array(scene.camera.position), (std::array{0.0, 0.0, 1.0}));
    EXPECT_EQ(std::to_array(scene.camera.target), (std::array{0.0, 0.0, 0.0}));
    EXPECT_EQ(scene.render.width, 512U);
    EXPECT_EQ(scene.render.height, 512U);
    EXPECT_EQ(scene.render.max_path_length, 6U);
    EXPECT_FALSE(scene.sample_count || scene.display.gamma != 0.0);
    EXPECT_EQ(scene.display.automatic_exposure, 1U);
}

std::string with_sphere(const std::string &members) {
    return "{\"spheres\":[{" + members + "}]}";
}

std::string with_camera(const std::string &members) {
    return R"({"camera":{"position":[0,0,0],"look_at":[0,0,1],)" + members + "}}";
}

TEST(SceneFile, SyntaxErrorsHaveLineAndColumn) {
    const std::pair<const char *, const char *> rows[] = {{"", "1:1"},
                                                          {"{\n  \"film\": NaN\n}", "2:11"},
                                                          {"{\n\n\"film\" {}}", "3:8"},
                                                          {"{} {}", "1:4"},
                                                          {R"({"film": {"width": 1,}})", "1:22"},
                                                          {"{\"film\": \"\xff\"}", "1:11"},
                                                          {R"({"film": {)", "1:11"},
                                                          {"{\n", "2:1"},
                                                          {R"({"film": {"width": 4 x}})", "1:22"},
                                                          {R"({"film": {"width": 4]})", "1:21"},
                                                          {R"({"film": {"width" 4}})", "1:19"},
                                                          {"\xef\xbb\xbf{,", "1:2"}}; // a byte order mark is no column
    for (const auto &[text, place] : rows) {
        EXPECT_TRUE(refusal(text).starts_with(std::string(place) + ": syntax error")) << refusal(text);
        EXPECT_EQ(refusal(text).find("a comma is missing"), std::string::npos) << text;
    }
}

TEST(SceneFile, AMissingCommaIsToldWhereItBelongs) {
    const std::pair<const char *, const char *> rows[] = {
        {"{\"film\": {\n\"width\": 4\n  \"height\": 2}}", "2:11"},
        {"{\"film\": {\n\"tonemap\": \"agx\" // a remark\n  \"height\": 2}}", "2:17"},
        {"{\"film\": {}\n\n\"render\": {}}", "1:12"},
        {"{\"camera\": {\"position\": [1, [2]\ntrue]}}", "1:32"}};
    for (const auto &[text, place] : rows)
        EXPECT_EQ(refusal(text), std::string(place) + ": syntax error: a comma is missing");
}

TEST(SceneFile, DeepNestingIsNotDangerous) {
    constexpr std::size_t depth = 100'000;
    const std::string open(depth, '[');
    const std::string close(depth, ']');
    EXPECT_EQ(refusal("{\"spheres\":[" + open + close + "]}"), "1: spheres[0]: must be an object, is an array");
    EXPECT_TRUE(refusal("{\"spheres\":[" + open).starts_with("1:100013: syntax error"));
}

TEST(SceneFile, RefusalsNameLinePlaceAndRule) {
    using namespace std::string_literals;
    const std::string whole = "must be a whole number from 1 to 4294967295, is ";
    const std::string exposure = "must be a number from -64 to 64 stops, or \"auto\", is ";
    const std::string angle = "1: camera.vertical_fov: must be a number from 6e-07 to below 180 degrees, is ";
    const std::string nul = "a NUL byte: this is not UTF-8 text";
    const std::pair<std::string, std::string> rows[] = {
        {"[]", "1: must contain an object, is an array"},
        {R"({"spheres":{}})", "1: spheres: must be an array, is an object"},
        {R"({"planes":[true]})", "1: planes[0]: must be an object, is true"},
        {R"({"materials":{"a":{"hidden_from_camera":1}}})",
         "1: materials.a.hidden_from_camera: must be true or false, is 1"},
        {R"({"materials":{"a/b":{"diffuse":[1,2]}}})",
         "1: materials[\"a/b\"].diffuse: must be a number or an array of 3 numbers, has 2"},
        {R"({"materials":{"a":{"glossiness":"0123456789012345678901234567890123456789"}}})",
         "1: materials.a.glossiness: must be a number, is a string"},
        {with_sphere(R"("center":[0,0,0],"radius":"two","material":"a")"),
         "1: spheres[0].radius: must be a number, is \"two\""},
        {with_sphere(R"("center":[0,0],"radius":1,"material":"a")"),
         "1: spheres[0].center: must be an array of 3 numbers, has 2"},
        {with_sphere(R"("center":3,"radius":1,"material":"a")"),
         "1: spheres[0].center: must be an array of 3 numbers, is 3"},
        {with_sphere(R"("center":[0,null,0],"radius":1,"material":"a")"),
         "1: spheres[0].center[1]: must be a number, is null"},
        {with_sphere(R"("center":[0,0,0],"radius":1,"material":3)"), "1: spheres[0].material: must be a string, is 3"},
        {with_sphere(R"("center":[0,0,0],"material":"a")"), "1: spheres[0]: \"radius\" is missing"},
        {"{\n\"spheres\": [\n{},\n3]}", "3: spheres[0]: \"center\" is missing"},
        {R"({"camera":{}})", "1: camera: \"position\" is missing"},
        {with_camera(R"("up":[0,0,0])"), "1: camera.up: must not be [0, 0, 0]"},
        {R"({"film":{"size":1}})",
         "1: film: unknown key \"size\", known: width, height, exposure, tonemap, gamma, white"},
        {"{\n\"film\": {},\n\"speres\": []}", "3: unknown key \"speres\", did you mean \"spheres\"?"},
        {"{\"film\": {\n\"widht\": 1}}", "2: film: unknown key \"widht\", did you mean \"width\"?"},
        {"{\"spheres\": [\n{\"center\": [0, 0, 0],\n\"raduis\": 1}]}",
         "3: spheres[0]: unknown key \"raduis\", did you mean \"radius\"?"},
        {R"({"render":{"sampler":"halton-pc"}})",
         "1: render.sampler: unknown sampler \"halton-pc\", did you mean \"halton-cp\"?"},
        {"{\"spheres\":[{\"center\":[0,0,0],\"radius\":1,\n\"material\":\"glod\"}],\"materials\":{\"gold\":{}}}",
         "2: spheres[0].material: unknown material \"glod\", did you mean \"gold\"?"},
        {R"({"film":{},"film":{}})", "1: film: is given twice"},
        {"{\n\"film\": {\n\"width\": 1,\n\"width\": 2}}", "4: film.width: is given twice"},
        {R"({"materials":{"a":{},"b":{},"a":{}}})", "1: materials.a: is given twice"},
        {with_sphere(R"("radius":1,"radius":2)"), "1: spheres[0].radius: is given twice"},
        {R"({"materials":{"width":{}},"film":{"width":1}})", ""},
        {R"({"film":{"width":1e400}})", "1: film.width: the number 1e400 is too large"},
        {"{\"planes\": [\n{\"normal\": [0,\n1e400\n]}]}", "3: planes[0].normal[1]: the number 1e400 is too large"},
        {R"({"materials":{"a":{"emission":1e39}}})",
         "1: materials.a.emission: must lie in the range of 32-bit floating point numbers, is 1e+39"},
        {"{\n\"film\": {\n\"width\":\n-1}}", "3: film.width: " + whole + "-1"},
        {R"({"film":{"width":1.5}})", "1: film.width: " + whole + "1.5"},
        {R"({"film":{"width":4294967296}})", "1: film.width: " + whole + "4294967296"},
        {R"({"film":{"exposure":"bright"}})", "1: film.exposure: " + exposure + "\"bright\""},
        {R"({"film":{"exposure":65}})", "1: film.exposure: " + exposure + "65"},
        {R"({"film":{"white":[1,0,1]}})", "1: film.white[1]: must be a number from 0.001 to 1000, is 0"},
        {R"({"film":{"gamma":-300000}})", "1: film.gamma: must be a number from 0.1 to 10, is -300000"},
        {R"({"film":{"gamma":1e+300}})", "1: film.gamma: must be a number from 0.1 to 10, is 1e+300"},
        {with_camera(R"("vertical_fov":0)"), angle + "0"},
        {with_camera(R"("vertical_fov":180)"), angle + "180"},
        {with_camera(R"("vertical_fov":6e-7)"), ""},
        {with_camera(R"("vertical_fov":179.9)"), ""},
        {"{}\0{}"s, "1:3: " + nul},
        {"{ // a remark\n \"film\": {\0} }"s, "2:11: " + nul},
        {"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR"s, "3:1: " + nul},
        {"\xff\xfe{\0"s, "1:4: " + nul}}; // UTF-16
    for (const auto &[text, expected] : rows)
        EXPECT_EQ(refusal(text), expected) << text;
}

TEST(SceneFile, SuggestionsAreTheNearestNames) {
    constexpr std::array<std::string_view, 4> known{"center", "side wall", "side walls", "side well"};
    for (const char *name : {"centre", "cetner", "Center"})
        EXPECT_EQ(pt::nearest_name(name, known), "center");
    EXPECT_EQ(pt::nearest_name("side wals", known), "side wall");
    EXPECT_EQ(pt::nearest_name("side wallss", known), "side walls");
    for (const char *name : {"emission", "x", ""})
        EXPECT_EQ(pt::nearest_name(name, known), "");
    EXPECT_EQ(pt::nearest_name("center", {}), "");
}

TEST(SceneFile, ExplainsWhatTheLibraryRefuses) {
    constexpr int none = -1;
    const SceneFile scene = parse_scene(small, "s.json");
    const std::pair<cli::BrokenRule, const char *> rows[] = {
        {{"spheres", 3, "radius", none, "", "-1", "must be > 0"}, ":3: spheres[3].radius = -1: must be > 0"},
        {{"materials", 2, "emission", 1, "", "-1", "x"}, ":7: materials.a.emission[1] = -1: x"},
        {{"materials", 99, "x", none, "", "0", "y"}, ":6: materials[99].x = 0: y"},
        {{"camera", none, "target", 1, "", "inf", "x"}, ":8: camera.look_at[1] = inf: x"},
        {{"camera", none, "shutter_close", none, "", "2", "x"}, ":9: camera.shutter[1] = 2: x"},
        {{"render", none, "width", none, "* height", "5", "x"}, ":10: film.width * height = 5: x"},
        {{"accumulate", none, "sample_count", none, "", "0", "y"}, ":11: render.spp = 0: y"},
        {{"create", none, "device", none, "", "7", "y"}, ": create.device = 7: y"},
        {{"scene", none, "", none, "", "NULL", "y"}, ": scene = NULL: y"}};
    for (const auto &[rule, expected] : rows)
        EXPECT_EQ(scene.explain(rule), std::string("s.json") + expected);
    EXPECT_EQ(explain(scene, cli::LibraryError{"out of everything", {}}), "s.json: out of everything");
    EXPECT_EQ(explain(scene, cli::LibraryError{"not read", {rows[0].first, rows[1].first}, 3}),
              std::string("s.json") + rows[0].second + "\ns.json" + rows[1].second + "\n... and 3 more");
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
