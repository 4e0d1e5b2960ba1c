#include "tests/api/api_fixture.h"
#include "tests/support/scene_of.h"
#include "tests/support/sized.h"

#include <pt/errors.h>

#include <cstring>
#include <limits>
#include <sstream>
#include <thread>

namespace api {

namespace {

pt_broken_rule rule_of(const pt_context *context, uint32_t index) {
    auto rule = sized<pt_broken_rule>();
    pt_get_broken_rule(context, index, &rule);
    return rule;
}

std::string text_of(const pt_broken_rule &rule) {
    std::ostringstream text;
    text << rule.subject;
    if (rule.index >= 0)
        text << '[' << rule.index << ']';
    if (*rule.member)
        text << '.' << rule.member;
    if (rule.component >= 0)
        text << '[' << rule.component << ']';
    if (*rule.with)
        text << ' ' << rule.with;
    text << " = " << rule.value << ": " << rule.rule;
    return text.str();
}

std::string all_text_of(const pt_context *context) {
    std::string text;
    for (uint32_t i = 0; i < pt_get_broken_rule(context, 0, nullptr); ++i)
        text.append(i == 0 ? "" : "\n").append(text_of(rule_of(context, i)));
    return text;
}

class ErrorsTest : public ApiTest {
protected:
    void expect_rule(pt_result result, const char *subject, int64_t index, const char *member, int32_t component) {
        EXPECT_LT(result, PT_OK);
        ASSERT_EQ(pt_get_broken_rule(context(), 0, nullptr), 1U) << message();
        const pt_broken_rule rule = rule_of(context(), 0);
        EXPECT_EQ(rule.struct_size, sizeof rule);
        EXPECT_STREQ(rule.subject, subject);
        EXPECT_EQ(rule.index, index);
        EXPECT_STREQ(rule.member, member);
        EXPECT_EQ(rule.component, component);
        EXPECT_EQ(text_of(rule), message());
    }
};

TEST_F(ErrorsTest, AreAboutNothingBeforeTheFirst) {
    EXPECT_EQ(pt_get_broken_rule(context(), 0, nullptr), 0U);
    EXPECT_EQ(rule_of(context(), 0).subject, nullptr);
}

TEST_F(ErrorsTest, NameTheFieldOfEachStruct) {
    set_all();
    pt_sphere ball = sphere;
    ball.center[2] = std::numeric_limits<double>::infinity();
    pt_scene scene = valid_scene();
    scene.spheres = &ball;
    expect_rule(pt_set_scene(context(), &scene), "spheres", 0, "center", 2);
    pt_material glossy = material;
    glossy.glossiness = -1;
    scene = valid_scene();
    scene.materials = &glossy;
    expect_rule(pt_set_scene(context(), &scene), "materials", 0, "glossiness", -1);
    scene.materials = nullptr;
    expect_rule(pt_set_scene(context(), &scene), "scene", -1, "materials", -1);
    pt_camera camera = valid_camera();
    camera.shutter_open = 2;
    camera.shutter_close = 3;
    EXPECT_EQ(pt_set_camera(context(), &camera), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(pt_get_broken_rule(context(), 0, nullptr), 2U);
    EXPECT_STREQ(rule_of(context(), 1).member, "shutter_close");
    EXPECT_EQ(all_text_of(context()), message());
    pt_render render = valid_render();
    render.max_path_length = 2000;
    expect_rule(pt_set_render(context(), &render), "render", -1, "max_path_length", -1);
    const pt_accumulate_info none = samples(0);
    expect_rule(pt_accumulate(context(), &none), "accumulate", -1, "sample_count", -1);
    accumulate(1);
    const pt_accumulate_info too_many = samples(UINT32_MAX);
    render = valid_render();
    render.first_sample = 2;
    ASSERT_EQ(pt_set_render(context(), &render), PT_OK);
    expect_rule(pt_accumulate(context(), &too_many), "accumulate", -1, "sample_count", -1);
    accumulate(1);
    std::vector<float> pixels(width * height * 3);
    pt_image image = tight_image(pixels);
    image.quantity = 8;
    expect_rule(pt_readback(context(), &image), "image", -1, "quantity", -1);
}

TEST_F(ErrorsTest, NameWhatElseEntersAValue) {
    pt_render render = valid_render();
    render.first_row = 1;
    render.row_count = height;
    expect_rule(pt_set_render(context(), &render), "render", -1, "first_row", -1);
    EXPECT_STREQ(rule_of(context(), 0).with, "+ row_count");
    render = valid_render();
    render.height = 1U << 30;
    render.width = 3;
    expect_rule(pt_set_render(context(), &render), "render", -1, "width", -1);
    EXPECT_STREQ(rule_of(context(), 0).with, "* rows");
}

TEST_F(ErrorsTest, NameArgumentsAndSizes) {
    expect_rule(pt_set_camera(context(), nullptr), "camera", -1, "", -1);
    pt_camera camera = valid_camera();
    camera.struct_size = 0;
    expect_rule(pt_set_camera(context(), &camera), "camera", -1, "struct_size", -1);
}

TEST_F(ErrorsTest, NameASphereThatThisCameraCannotSee) {
    pt_sphere huge = sphere;
    huge.center[1] = -1e9 - 1;
    huge.radius = 1e9;
    huge.motion[0] = 1e9;
    const pt_sphere balls[2] = {sphere, huge};
    const pt_scene scene = scene_of({&material, 1}, balls, {});
    set_all();
    ASSERT_EQ(pt_set_scene(context(), &scene), PT_OK) << message();
    const pt_accumulate_info one = samples(1);
    expect_rule(pt_accumulate(context(), &one), "spheres", 1, "motion", -1);
}

TEST_F(ErrorsTest, KeepEightAndCountAll) {
    const std::vector<pt_sphere> balls(20, {{0, 0, 0}, -1, {0, 0, 0}, 0, 0});
    const pt_scene scene = scene_of({&material, 1}, balls, {});
    EXPECT_EQ(pt_set_scene(context(), &scene), PT_ERROR_INVALID_SCENE);
    EXPECT_EQ(pt_get_broken_rule(context(), 0, nullptr), 20U);
    EXPECT_EQ(rule_of(context(), 7).index, 7);
    EXPECT_EQ(rule_of(context(), 8).subject, nullptr);
    EXPECT_TRUE(message().ends_with("\nspheres[7].radius = -1: must be > 0\n... and 12 more")) << message();
}

TEST_F(ErrorsTest, StayAsLongAsTheMessage) {
    set_all();
    EXPECT_LT(pt_set_camera(context(), nullptr), PT_OK);
    const pt_broken_rule before = rule_of(context(), 0);
    set_all();
    EXPECT_STREQ(before.subject, "camera");
    EXPECT_EQ(rule_of(context(), 0).subject, before.subject);
    std::vector<float> pixels(width * height * 3);
    const pt_image image = tight_image(pixels);
    EXPECT_EQ(pt_readback(context(), &image), PT_ERROR_INVALID_STATE);
    EXPECT_EQ(pt_get_broken_rule(context(), 0, nullptr), 0U);
}

TEST_F(ErrorsTest, WriteNoMoreThanTheCallerKnows) {
    EXPECT_LT(pt_set_camera(context(), nullptr), PT_OK);
    pt_broken_rule rule;
    std::memset(&rule, 0x55, sizeof rule);
    const pt_broken_rule untouched = rule;
    for (const uint32_t size : {0U, 3U, 65537U}) {
        rule.struct_size = size;
        EXPECT_EQ(pt_get_broken_rule(context(), 0, &rule), 1U);
        EXPECT_EQ(rule.subject, untouched.subject) << size;
    }
    rule.struct_size = offsetof(pt_broken_rule, value);
    EXPECT_EQ(pt_get_broken_rule(context(), 0, &rule), 1U);
    EXPECT_STREQ(rule.subject, "camera");
    EXPECT_EQ(rule.value, untouched.value);
}

TEST_F(ErrorsTest, BelongToWhoMayLookAtThem) {
    set_all();
    EXPECT_LT(pt_set_camera(context(), nullptr), PT_OK);
    struct Seen {
        pt_context *context;
        uint64_t before, refused, elsewhere;
    } seen{context(), 9, 9, 9};
    const auto look = [](void *user, double) -> int32_t {
        Seen &found = *static_cast<Seen *>(user);
        found.before = pt_get_broken_rule(found.context, 0, nullptr);
        std::thread([&] { found.elsewhere = pt_get_broken_rule(found.context, 0, nullptr); }).join();
        pt_set_camera(found.context, nullptr);
        found.refused = pt_get_broken_rule(found.context, 0, nullptr);
        return 1;
    };
    const pt_accumulate_info info = accumulate_info(1, 0.0, look, &seen);
    EXPECT_GE(pt_accumulate(context(), &info), PT_OK) << message();
    EXPECT_EQ(seen.before, 1U);
    EXPECT_EQ(seen.elsewhere, 0U);
    EXPECT_EQ(seen.refused, 0U);
}

TEST(Errors, WithoutAContextBelongToTheirThread) {
    EXPECT_EQ(pt_create(nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(all_text_of(nullptr), pt_last_error(nullptr));
    std::thread([] {
        EXPECT_EQ(pt_get_broken_rule(nullptr, 0, nullptr), 0U);
        EXPECT_STREQ(pt_last_error(nullptr), "");
    }).join();
    auto info = sized<pt_create_info>();
    info.device = "999";
    pt_context *context = nullptr;
    EXPECT_EQ(pt_create(&info, &context), PT_ERROR_NO_DEVICE);
    EXPECT_STREQ(rule_of(nullptr, 0).subject, "create");
    EXPECT_STREQ(rule_of(nullptr, 0).member, "device");
    EXPECT_EQ(all_text_of(nullptr), pt_last_error(nullptr));
}

} // namespace

} // namespace api
