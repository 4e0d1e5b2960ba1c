#include "tests/support/sized.h"

#include <pt/scene_file.h>

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>
#include <thread>

namespace {

constexpr const char *room = R"({"materials": {"red": {}},
"spheres": [{"center": [1, 2, 3], "radius": 4, "material": "red"}],
"capsules": [{"center": [0, 0, 0], "end": [0, 1, 0], "radius": 0.5, "material": "red"}],
"planes": [{"normal": [0, 1, 0], "offset": 7, "material": "red"}],
"film": {"width": 30, "height": 20}, "render": {"seed": 5}})";

struct Close {
    void operator()(pt_scene_file *file) const { pt_close_scene_file(file); }
};
using File = std::unique_ptr<pt_scene_file, Close>;

pt_scene_file_info info_of(const std::string &text) {
    auto info = sized<pt_scene_file_info>();
    info.path = "s.json";
    info.text = text.c_str();
    info.text_bytes = text.size();
    return info;
}

File opened(const pt_scene_file_info &info) {
    pt_scene_file *file = nullptr;
    EXPECT_EQ(pt_open_scene_file(&info, &file), PT_OK) << pt_last_scene_error();
    return File(file);
}

std::string refusal(const pt_scene_file_info &info, pt_result expected) {
    auto *file = reinterpret_cast<pt_scene_file *>(-1);
    EXPECT_EQ(pt_open_scene_file(&info, &file), expected);
    EXPECT_EQ(file, nullptr);
    return pt_last_scene_error();
}

TEST(SceneFileCalls, WriteNoMoreThanStructSize) {
    const File file = opened(info_of(room));
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
    const File file = opened(info_of(room));
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

// Callers may pass rules about fields that this file does not have.
TEST(SceneFileCalls, TakeAnyRule) {
    const File file = opened(info_of(room));
    auto rule = sized<pt_broken_rule>();
    auto source = sized<pt_rule_source>();
    const auto expect_message = [&] {
        EXPECT_EQ(pt_find_rule_source(file.get(), &rule, &source), PT_OK) << pt_last_scene_error();
        EXPECT_TRUE(std::string(source.message).starts_with("s.json"));
    };
    expect_message();
    rule.component = -1;
    rule.member = "material";
    for (const char *subject : {"sphere_arrays", "materials", "spheres", "planes", "", "nothing"}) {
        for (const std::int64_t index : {std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, INT64_MAX, INT64_MIN}) {
            for (const char *value : {"-1", "7", "99999999999999999999", "x", ""}) {
                rule.subject = subject;
                rule.index = index;
                rule.value = value;
                expect_message();
            }
        }
    }
}

TEST(SceneFileCalls, KeepAnErrorPerThread) {
    refusal(info_of("["), PT_ERROR_INVALID_SCENE);
    const std::string mine = pt_last_scene_error();
    std::thread([] {
        EXPECT_STREQ(pt_last_scene_error(), "");
        refusal(info_of("{} {}"), PT_ERROR_INVALID_SCENE);
    }).join();
    EXPECT_EQ(pt_last_scene_error(), mine);
}

} // namespace
