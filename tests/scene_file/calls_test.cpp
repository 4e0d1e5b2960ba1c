#include <pt/scene_file.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr const char *room = R"({"materials": {"red": {"diffuse": [0.5, 0, 0]}, "lamp": {"emission": 2}},
"spheres": [{"center": [1, 2, 3], "radius": 4, "material": "lamp"}],
"capsules": [{"center": [0, 0, 0], "end": [0, 1, 0], "radius": 0.5, "material": "red", "opacity": 0.5}],
"planes": [{"normal": [0, 1, 0], "offset": 7, "material": "red"}],
"camera": {"position": [0, 0, 9], "look_at": [0, 0, 0],
"vertical_fov": 90},
"film": {"width": 30, "height": 20, "exposure": -2.5, "tonemap": "aces", "gamma": 1.5},
"render": {"spp": 12, "seed": 5},
"animation": {"camera.position": [[0, [0, 0, 9]], [4, [4, 0, 9]]]}})";

struct Close {
    void operator()(pt_scene_file *file) const { pt_close_scene_file(file); }
};
using File = std::unique_ptr<pt_scene_file, Close>;

template <typename Struct>
Struct sized() {
    Struct value{};
    value.struct_size = sizeof value;
    return value;
}

pt_scene_file_info info_of(const std::string &text, const std::vector<pt_scene_override> &overrides = {}) {
    auto info = sized<pt_scene_file_info>();
    info.path = "s.json";
    info.text = text.c_str();
    info.text_bytes = text.size();
    info.overrides = overrides.data();
    info.override_count = static_cast<std::uint32_t>(overrides.size());
    return info;
}

File opened(const pt_scene_file_info &info) {
    pt_scene_file *file = nullptr;
    EXPECT_EQ(pt_open_scene_file(&info, &file), PT_OK) << pt_last_scene_error();
    return File(file);
}

File opened(const std::string &text, const std::vector<pt_scene_override> &overrides = {}) {
    return opened(info_of(text, overrides));
}

std::string refusal(const pt_scene_file_info &info, pt_result expected) {
    auto *file = reinterpret_cast<pt_scene_file *>(-1);
    EXPECT_EQ(pt_open_scene_file(&info, &file), expected);
    EXPECT_EQ(file, nullptr);
    return pt_last_scene_error();
}

std::string refusal(const std::string &text, pt_result expected, const std::vector<pt_scene_override> &overrides = {}) {
    return refusal(info_of(text, overrides), expected);
}

pt_broken_rule rule_of(const char *subject, std::int64_t index, const char *member) {
    auto rule = sized<pt_broken_rule>();
    rule.subject = subject;
    rule.index = index;
    rule.member = member;
    rule.component = -1;
    rule.value = "-1";
    rule.rule = "must be > 0";
    return rule;
}

pt_rule_source source_of(const File &file, const pt_broken_rule &rule) {
    auto source = sized<pt_rule_source>();
    EXPECT_EQ(pt_find_rule_source(file.get(), &rule, &source), PT_OK) << pt_last_scene_error();
    return source;
}

TEST(SceneFileCalls, GiveTheWholeFile) {
    const File file = opened(room);
    auto scene = sized<pt_scene>();
    auto camera = sized<pt_camera>();
    auto render = sized<pt_render>();
    auto film = sized<pt_scene_film>();
    ASSERT_EQ(pt_get_scene_file(file.get(), &scene, &camera, &render, &film), PT_OK);
    ASSERT_EQ(scene.material_count, 2U);
    EXPECT_EQ(scene.materials[0].diffuse[0], 0.5F);
    EXPECT_EQ(scene.materials[1].emission[2], 2.0F);
    ASSERT_EQ(scene.sphere_count, 1U);
    EXPECT_EQ(scene.spheres[0].center[2], 3.0);
    EXPECT_EQ(scene.spheres[0].material, 1U);
    ASSERT_EQ(scene.plane_count, 1U);
    EXPECT_EQ(scene.planes[0].offset, 7.0);
    ASSERT_EQ(scene.sphere_array_count, 1U);
    EXPECT_EQ(*static_cast<const float *>(scene.sphere_arrays[0].opacity.data), 0.5F);
    EXPECT_EQ(camera.position[2], 9.0);
    EXPECT_NEAR(camera.vertical_fov, std::acos(0.0), 1e-15);
    EXPECT_EQ(camera.shutter_close, 1.0);
    EXPECT_EQ(render.width, 30U);
    EXPECT_EQ(render.seed, 5U);
    EXPECT_EQ(film.sample_count, 12U);
    EXPECT_EQ(film.display.curve, 2U);
    EXPECT_EQ(film.display.automatic_exposure, 0U);
    EXPECT_EQ(film.display.exposure, -2.5);
    EXPECT_EQ(film.display.gamma, 1.5);
}

TEST(SceneFileCalls, HaveDefaults) {
    const File file = opened("{}");
    auto render = sized<pt_render>();
    auto film = sized<pt_scene_film>();
    ASSERT_EQ(pt_get_scene_file(file.get(), nullptr, nullptr, &render, &film), PT_OK);
    EXPECT_EQ(render.width, 512U);
    EXPECT_EQ(film.sample_count, 0U);
    EXPECT_EQ(film.display.automatic_exposure, 1U);
    EXPECT_EQ(film.display.gamma, 0.0);
}

TEST(SceneFileCalls, WriteNoMoreThanStructSize) {
    const File file = opened(room);
    pt_render render{};
    std::memset(&render, 0x55, sizeof render);
    const pt_render before = render;
    render.struct_size = offsetof(pt_render, height);
    ASSERT_EQ(pt_get_scene_file(file.get(), nullptr, nullptr, &render, nullptr), PT_OK);
    EXPECT_EQ(render.width, 30U);
    EXPECT_EQ(render.height, before.height);
    EXPECT_EQ(render.seed, before.seed);
}

TEST(SceneFileCalls, RefuseWrongStructsBeforeTheyWrite) {
    const File file = opened(room);
    auto camera = sized<pt_camera>();
    pt_render unsized{};
    EXPECT_EQ(pt_get_scene_file(file.get(), nullptr, &camera, &unsized, nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(pt_last_scene_error(),
                 "render.struct_size = 0: must be the size of the struct, which holds this field");
    EXPECT_EQ(camera.position[2], 0.0);
    EXPECT_EQ(pt_get_scene_file(nullptr, nullptr, nullptr, nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(pt_last_scene_error(), "file = NULL: must not be NULL");
}

TEST(SceneFileCalls, RefuseWrongInfos) {
    EXPECT_EQ(pt_open_scene_file(nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
    auto info = sized<pt_scene_file_info>();
    EXPECT_EQ(refusal(info, PT_ERROR_INVALID_ARGUMENT), "info.path = NULL: must not be NULL");
    info.path = "s.json";
    info.frame = 3;
    EXPECT_EQ(refusal(info, PT_ERROR_INVALID_ARGUMENT), "info.frame = 3: must be 0 without PT_SCENE_FILE_FRAME");
    info.flags = 8;
    EXPECT_EQ(refusal(info, PT_ERROR_UNSUPPORTED), "info.flags = 8: must be PT_SCENE_FILE_FRAME or 0");
    info.flags = PT_SCENE_FILE_FRAME;
    info.text_bytes = 1;
    EXPECT_EQ(refusal(info, PT_ERROR_INVALID_ARGUMENT), "info.text_bytes = 1: must be 0 without a text");
    info.text_bytes = 0;
    info.override_count = 1;
    EXPECT_EQ(refusal(info, PT_ERROR_INVALID_ARGUMENT),
              "info.overrides = NULL: must not be NULL with an override_count");
    const pt_scene_override none{};
    info.overrides = &none;
    EXPECT_EQ(refusal(info, PT_ERROR_INVALID_ARGUMENT), "overrides.setting = NULL: must not be NULL");
    pt_close_scene_file(nullptr);
}

TEST(SceneFileCalls, RefuseWrongFiles) {
    EXPECT_EQ(refusal("{\"spheres\": [\n{\"radius\": 1 \"x\"}]}", PT_ERROR_INVALID_SCENE),
              "s.json:2:13: syntax error: a comma is missing");
    EXPECT_EQ(refusal("{\"camera\": {\n\"raduis\": 1}}", PT_ERROR_INVALID_SCENE).substr(0, 39),
              "s.json:2: camera: unknown key \"raduis\",");
    auto info = sized<pt_scene_file_info>();
    info.path = "absent/s.json";
    EXPECT_EQ(refusal(info, PT_ERROR_FILE), "cannot read absent/s.json: No such file or directory");
}

TEST(SceneFileCalls, BlameOverrides) {
    EXPECT_EQ(refusal("{}", PT_ERROR_INVALID_ARGUMENT, {{"film.width=0", "--width"}}).substr(0, 33),
              "--width: must be a whole number f");
    EXPECT_EQ(refusal("{}", PT_ERROR_INVALID_ARGUMENT, {{"nothing", nullptr}}).substr(0, 38),
              "nothing: must be a value within a sect");
    const File file =
        opened(room, {{"film.width=99", nullptr}, {"film.tonemap=agx", nullptr}, {"film.width=98", nullptr}});
    auto render = sized<pt_render>();
    auto film = sized<pt_scene_film>();
    ASSERT_EQ(pt_get_scene_file(file.get(), nullptr, nullptr, &render, &film), PT_OK);
    EXPECT_EQ(render.width, 98U);
    EXPECT_EQ(film.display.curve, 3U);
}

TEST(SceneFileCalls, FindTheSourceOfARule) {
    const File file = opened(room, {{"materials.red.glossiness=-1", nullptr}, {"camera.focus=-1", "--focus"}});
    const pt_rule_source in_file = source_of(file, rule_of("spheres", 0, "radius"));
    EXPECT_STREQ(in_file.message, "s.json:2: spheres[0].radius = -1: must be > 0");
    EXPECT_EQ(in_file.line, 2U);
    EXPECT_EQ(in_file.override_index, -1);
    const pt_rule_source in_override = source_of(file, rule_of("camera", -1, "focus"));
    EXPECT_STREQ(in_override.message, "--focus = -1: must be > 0");
    EXPECT_EQ(in_override.line, 0U);
    EXPECT_EQ(in_override.override_index, 1);
    const pt_rule_source nowhere = source_of(file, rule_of("create", -1, "device"));
    EXPECT_STREQ(nowhere.message, "s.json: create.device = -1: must be > 0");
    EXPECT_EQ(nowhere.line, 0U);
}

// Callers may pass rules about fields that this file does not have.
TEST(SceneFileCalls, TakeAnyRule) {
    const File file = opened(room);
    for (const char *subject : {"sphere_arrays", "materials", "spheres", "planes", "", "nothing"}) {
        for (const std::int64_t index : {std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, INT64_MAX, INT64_MIN}) {
            for (const char *value : {"-1", "7", "99999999999999999999", "x", ""}) {
                pt_broken_rule rule = rule_of(subject, index, "material");
                rule.value = value;
                EXPECT_TRUE(std::string(source_of(file, rule).message).starts_with("s.json"));
            }
        }
    }
    pt_broken_rule empty = sized<pt_broken_rule>();
    EXPECT_TRUE(std::string(source_of(file, empty).message).starts_with("s.json"));
}

TEST(SceneFileCalls, GiveFrames) {
    const std::string text = room;
    pt_scene_file_info info = info_of(text);
    info.flags = PT_SCENE_FILE_FRAME;
    info.frame = 2;
    const File file = opened(info);
    auto camera = sized<pt_camera>();
    auto render = sized<pt_render>();
    ASSERT_EQ(pt_get_scene_file(file.get(), nullptr, &camera, &render, nullptr), PT_OK);
    EXPECT_EQ(camera.position[0], 2.5); // in the middle of the shutter's time
    EXPECT_EQ(render.seed, 7U);
    EXPECT_EQ(source_of(file, rule_of("camera", -1, "position")).override_index, -1);
    info.text = "{}";
    info.text_bytes = 2;
    EXPECT_EQ(refusal(info, PT_ERROR_INVALID_SCENE), "s.json: has no animation, and therefore no frames");
}

TEST(SceneFileCalls, ReadColumns) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "pt_scene_file_calls";
    std::filesystem::create_directories(folder);
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }";
    header.resize(117, ' ');
    std::string npy = std::string("\x93NUMPY\x01\x00", 8) + std::string("\x76\x00", 2) + header + "\n";
    const float centers[6] = {1, 2, 3, 4, 5, 6};
    npy.append(reinterpret_cast<const char *>(centers), sizeof centers);
    std::ofstream(folder / "c.npy", std::ios::binary) << npy;
    const std::string text =
        R"({"materials": {"m": {}}, "spheres": [{"center": "c.npy", "radius": 1, "material": "m"}]})";
    const std::string path = (folder / "s.json").string();
    pt_scene_file_info info = info_of(text);
    info.path = path.c_str();
    const File file = opened(info);
    EXPECT_EQ(pt_get_column_path(file.get(), 0), (folder / "c.npy").string());
    EXPECT_EQ(pt_get_column_path(file.get(), 1), nullptr);
    auto scene = sized<pt_scene>();
    ASSERT_EQ(pt_get_scene_file(file.get(), &scene, nullptr, nullptr, nullptr), PT_OK);
    ASSERT_EQ(scene.sphere_array_count, 1U);
    EXPECT_EQ(scene.sphere_arrays[0].count, 2U);
    EXPECT_EQ(static_cast<const float *>(scene.sphere_arrays[0].center.data)[5], 6.0F);
    std::filesystem::remove_all(folder);
    EXPECT_NE(refusal(info, PT_ERROR_FILE).find("spheres[0].center: cannot read "), std::string::npos);
}

TEST(SceneFileCalls, KeepAnErrorPerThread) {
    refusal("[", PT_ERROR_INVALID_SCENE);
    const std::string mine = pt_last_scene_error();
    std::thread([] {
        EXPECT_STREQ(pt_last_scene_error(), "");
        refusal("{} {}", PT_ERROR_INVALID_SCENE);
    }).join();
    EXPECT_EQ(pt_last_scene_error(), mine);
}

TEST(SceneFileCalls, GiveTheSchema) {
    const char *schema = pt_get_scene_schema();
    ASSERT_NE(schema, nullptr);
    EXPECT_EQ(std::string(schema).rfind("{\n  \"$schema\": \"http://json-schema.org/draft-07/schema#\"", 0), 0U);
    EXPECT_EQ(pt_get_scene_schema(), schema);
}

} // namespace
