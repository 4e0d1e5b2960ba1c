#include "lib/api/guard.h"
#include "lib/base/log.h"
#include "tests/api/api_fixture.h"
#include "tests/support/scene_of.h"
#include "tests/support/sized.h"

#include <pt/errors.h>
#include <pt/shaders.h>

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

TEST_F(ErrorsTest, NameTheFieldOfEachStruct) {
    EXPECT_EQ(pt_get_broken_rule(context(), 0, nullptr), 0U);
    EXPECT_EQ(rule_of(context(), 0).subject, nullptr);
    set_all();
    pt_sphere ball = sphere;
    ball.center[2] = std::numeric_limits<double>::infinity();
    pt_scene scene = valid_scene();
    scene.spheres = &ball;
    expect_rule(pt_set_scene(context(), &scene), "spheres", 0, "center", 2);
    pt_render render = valid_render();
    render.first_row = 1;
    render.row_count = height;
    expect_rule(pt_set_render(context(), &render), "render", -1, "first_row", -1);
    EXPECT_STREQ(rule_of(context(), 0).with, "+ row_count");
    const pt_accumulate_info none = accumulate_info(0);
    expect_rule(pt_accumulate(context(), &none), "accumulate", -1, "sample_count", -1);
    accumulate(1);
    std::vector<float> pixels(width * height * 3);
    const pt_image image = image_target(pixels, 8);
    expect_rule(pt_readback(context(), &image), "image", -1, "quantity", -1);
    pt_camera camera = valid_camera();
    camera.struct_size = 0;
    expect_rule(pt_set_camera(context(), &camera), "camera", -1, "struct_size", -1);
    expect_rule(pt_set_camera(context(), nullptr), "camera", -1, "", -1);
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
    EXPECT_LT(pt_set_camera(context(), nullptr), PT_OK);
    const pt_broken_rule before = rule_of(context(), 0);
    set_all();
    EXPECT_STREQ(before.subject, "camera");
    EXPECT_EQ(rule_of(context(), 0).subject, before.subject);
    EXPECT_EQ(pt_reload_shaders(context()), PT_ERROR_INVALID_STATE);
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

TEST(Errors, WithoutAContextBelongToTheirThread) {
    auto info = sized<pt_create_info>();
    info.device = "999";
    pt_context *context = nullptr;
    EXPECT_EQ(pt_create(&info, &context), PT_ERROR_NO_DEVICE);
    EXPECT_STREQ(rule_of(nullptr, 0).subject, "create");
    EXPECT_STREQ(rule_of(nullptr, 0).member, "device");
    EXPECT_EQ(text_of(rule_of(nullptr, 0)), pt_last_error(nullptr));
    std::thread([] {
        EXPECT_EQ(pt_get_broken_rule(nullptr, 0, nullptr), 0U);
        EXPECT_STREQ(pt_last_error(nullptr), "");
    }).join();
}

TEST(Errors, AnythingThrownIsInternal) {
    pt::LastError last_error;
    EXPECT_EQ(pt::guard(last_error, [] { throw 7; }), PT_ERROR_INTERNAL);
    EXPECT_STREQ(last_error.c_str(), "an exception of unknown type");
    EXPECT_STREQ(pt_result_name(5), "unknown result");
}

TEST(Log, PassesOnLineByLine) {
    std::vector<std::string> lines;
    const auto receive = [](void *user, int32_t level, const char *line) {
        static_cast<std::vector<std::string> *>(user)->push_back(std::to_string(level) + line);
    };
    const pt::Log log{receive, &lines};
    log.write(PT_LOG_WARNING, "one\n\nthree");
    log.write(PT_LOG_INFO, "ends\n");
    EXPECT_EQ(lines, (std::vector<std::string>{"2one", "2", "2three", "3ends"}));
    const pt::Log throws{[](void *, int32_t, const char *) { throw 7; }, nullptr};
    EXPECT_NO_THROW(throws.write(PT_LOG_ERROR, "dropped"));
    pt::Log().write(PT_LOG_ERROR, "nobody reads this");
}

} // namespace

} // namespace api
