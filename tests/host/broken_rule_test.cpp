// Broken rules: their words, how many are kept, and that they come through Error to LastError.
#include "lib/api/guard.h"
#include "lib/base/rules.h"
#include "tests/support/expected_error.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace {

using pt::BrokenRule;
using pt::BrokenRules;

TEST(BrokenRule, IsPutIntoWords) {
    EXPECT_EQ((BrokenRule{.subject = "count", .value = "NULL", .rule = "must not be NULL"}).text(),
              "count = NULL: must not be NULL");
    EXPECT_EQ((BrokenRule{.subject = "camera", .member = "up", .component = 2, .value = "nan", .rule = "r"}).text(),
              "camera.up[2] = nan: r");
    EXPECT_EQ((BrokenRule{.subject = "spheres", .index = 3, .member = "radius", .value = "-1", .rule = "r"}).text(),
              "spheres[3].radius = -1: r");
    EXPECT_EQ(
        (BrokenRule{.subject = "render", .member = "width", .with = "* height", .value = "0", .rule = "r"}).text(),
        "render.width * height = 0: r");
}

TEST(BrokenRules, KeepTheFirstAndCountAll) {
    BrokenRules rules;
    EXPECT_EQ(rules.text(), "");
    for (std::size_t i = 0; i < BrokenRules::most_kept + 2; ++i)
        rules.add({.subject = "x", .index = static_cast<std::int64_t>(i), .value = "1", .rule = "r"});
    EXPECT_EQ(rules.count(), BrokenRules::most_kept + 2);
    ASSERT_EQ(rules.first().size(), BrokenRules::most_kept);
    EXPECT_EQ(rules.first().back().index, 7);
    EXPECT_TRUE(rules.text().starts_with("x[0] = 1: r\nx[1] = 1: r\n")) << rules.text();
    EXPECT_TRUE(rules.text().ends_with("x[7] = 1: r\n... and 2 more")) << rules.text();
}

// What each way to refuse a field of a subject makes of it.
TEST(Subject, RefusesByMemberAndComponent) {
    pt::Violations violations;
    violations.throw_if_any(PT_ERROR_INVALID_SCENE); // nothing yet
    const pt::Subject sphere(violations, "spheres", 5);
    const double center[3] = {0, 1e300, 0};
    sphere.check("radius", -1.0, pt::positive_length_rule);
    sphere.check("radius", 1.0, pt::positive_length_rule);
    sphere.check_each("center", center, pt::length_rule);
    const pt::Subject render(violations, "render");
    render.require(false, {"width", "* height"}, 0U, "must be >= 1");
    render.require(true, "height", 0U, "must be >= 1");
    render.refuse("data", "NULL", "must not be NULL");

    const pt::Error error = error_of([&] { violations.throw_if_any(PT_ERROR_INVALID_SCENE); });
    EXPECT_EQ(error.code(), PT_ERROR_INVALID_SCENE);
    EXPECT_STREQ(error.what(), "spheres[5].radius = -1: must be > 0\n"
                               "spheres[5].center[1] = 1e+300: must be 0 or of a magnitude in [1e-18, 1e18]\n"
                               "render.width * height = 0: must be >= 1\n"
                               "render.data = NULL: must not be NULL");
    ASSERT_TRUE(error.broken_rules());
    ASSERT_EQ(error.broken_rules()->count(), 4U);
    const BrokenRule &center_rule = error.broken_rules()->first()[1];
    EXPECT_EQ(center_rule.subject, "spheres");
    EXPECT_EQ(center_rule.index, 5);
    EXPECT_EQ(center_rule.member, "center");
    EXPECT_EQ(center_rule.component, 1);
    EXPECT_EQ(center_rule.value, "1e+300");
    const BrokenRule &size_rule = error.broken_rules()->first()[2];
    EXPECT_EQ(size_rule.index, -1);
    EXPECT_EQ(size_rule.member, "width");
    EXPECT_EQ(size_rule.component, -1);
    EXPECT_EQ(size_rule.with, "* height");
}

pt_result refuse_a_radius(pt::LastError &last_error) {
    return pt::guard(last_error, [] {
        throw pt::Error(PT_ERROR_UNSUPPORTED,
                        BrokenRule{.subject = "spheres", .index = 0, .member = "radius", .value = "1", .rule = "r"});
    });
}

TEST(LastError, HasTheRulesOfTheLastFailureAlone) {
    pt::LastError last_error;
    EXPECT_EQ(last_error.broken_rules(), nullptr);
    EXPECT_EQ(refuse_a_radius(last_error), PT_ERROR_UNSUPPORTED);
    ASSERT_TRUE(last_error.broken_rules());
    EXPECT_EQ(last_error.broken_rules()->first().front().member, "radius");
    EXPECT_EQ(last_error.broken_rules()->text(), last_error.c_str());

    EXPECT_EQ(pt::guard(last_error, [] {}), PT_OK);
    EXPECT_TRUE(last_error.broken_rules()); // like the message
    EXPECT_EQ(pt::guard(last_error, [] { throw pt::Error(PT_ERROR_DEVICE_LOST, "why"); }), PT_ERROR_DEVICE_LOST);
    EXPECT_EQ(last_error.broken_rules(), nullptr);
}

// A message longer than any string makes std::string throw before it touches memory.
TEST(LastError, HasNoRulesWhereThereIsNoMemoryForTheMessage) {
    pt::LastError last_error;
    refuse_a_radius(last_error);
    ASSERT_TRUE(last_error.broken_rules());
    last_error.store(std::string_view("x", std::string().max_size() + 1), std::make_shared<const BrokenRules>());
    EXPECT_EQ(last_error.broken_rules(), nullptr);
}

} // namespace
