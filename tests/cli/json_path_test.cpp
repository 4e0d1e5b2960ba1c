// Tests of cli/json_path, and of the lines that cli/scene/json_items finds.
#include "cli/scene/json_items.h"

#include <gtest/gtest.h>

#include <optional>
#include <string_view>

namespace {

using cli::JsonPath;
using cli::JsonStep;
using cli::path_text;

JsonStep key(const char *name) {
    return {name, 0, false};
}

JsonStep element(std::size_t index) {
    return {"", index, true};
}

TEST(JsonPath, Text) {
    EXPECT_EQ(path_text({}), "");
    EXPECT_EQ(path_text({{"spheres", 0, false}, {"", 3, true}, {"radius", 0, false}}), "spheres[3].radius");
    EXPECT_EQ(path_text({{"materials", 0, false}, {"blue ball", 0, false}, {"diffuse", 0, false}, {"", 0, true}}),
              "materials[\"blue ball\"].diffuse[0]");
    EXPECT_EQ(path_text({{"a\"b\n", 0, false}}), "[\"a\\\"b\\n\"]");
    EXPECT_EQ(path_text({{"", 0, false}}), "[\"\"]");
}

TEST(JsonPath, LineOfAKeyOrAnElement) {
    constexpr std::string_view text = "{ // a comment\n"
                                      "\"a\": 1,\n"
                                      "\"list\": [10,\n"
                                      "11\n"
                                      ", [1,\n"
                                      "{\"x\":\n"
                                      "\"y\"}]],\n"
                                      "\"odd \\u006eame\": {\"a\": 2}}";
    EXPECT_EQ(cli::line_of(text, {}), 1U);
    EXPECT_EQ(cli::line_of(text, {key("a")}), 2U);
    EXPECT_EQ(cli::line_of(text, {key("list")}), 3U);
    EXPECT_EQ(cli::line_of(text, {key("list"), element(0)}), 3U);
    EXPECT_EQ(cli::line_of(text, {key("list"), element(1)}), 4U); // though the parser has read the line's end by then
    EXPECT_EQ(cli::line_of(text, {key("list"), element(2)}), 5U);
    EXPECT_EQ(cli::line_of(text, {key("list"), element(2), element(1), key("x")}), 6U);
    EXPECT_EQ(cli::line_of(text, {{"odd name", 0, false}, {"a", 0, false}}), 8U); // and not the first "a"
}

TEST(JsonPath, WhatIsNotThereHasTheLineOfWhatIsAroundIt) {
    constexpr std::string_view text = "{\n\"list\": [1,\n{\"x\": 1}\n]}";
    EXPECT_EQ(cli::line_of(text, {key("list"), element(1), key("y")}), 3U);
    EXPECT_EQ(cli::line_of(text, {key("list"), element(7), key("y")}), 2U);
    EXPECT_EQ(cli::line_of(text, {key("other"), key("y")}), std::nullopt);
}

TEST(JsonPath, TheSecondOfTwo) {
    constexpr std::string_view text = "{\n\"a\": 1,\n\"a\": 2}";
    EXPECT_EQ(cli::line_of(text, {key("a")}), 3U);
}

TEST(JsonPath, BrokenTextIsReadAsFarAsItGoes) {
    EXPECT_EQ(cli::line_of("{\n\"a\": [\n1e999", {key("a"), element(0)}), 3U);
}

} // namespace
