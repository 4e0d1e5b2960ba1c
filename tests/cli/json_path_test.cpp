// Tests of cli/json_path.
#include "cli/base/json_path.h"

#include <gtest/gtest.h>

#include <string>

namespace {

using cli::find_line;
using cli::JsonPath;
using cli::path_text;
using cli::take_path;

JsonPath path_of(std::string_view text) {
    JsonPath path = take_path(text);
    EXPECT_EQ(text, "");
    return path;
}

TEST(JsonPath, Text) {
    EXPECT_EQ(path_text({}), "");
    EXPECT_EQ(path_text({{"spheres", 0, false}, {"", 3, true}, {"radius", 0, false}}), "spheres[3].radius");
    EXPECT_EQ(path_text({{"materials", 0, false}, {"blue ball", 0, false}, {"diffuse", 0, false}, {"", 0, true}}),
              "materials[\"blue ball\"].diffuse[0]");
    EXPECT_EQ(path_text({{"a\"b\n", 0, false}}), "[\"a\\\"b\\n\"]");
    EXPECT_EQ(path_text({{"", 0, false}}), "[\"\"]");
}

TEST(JsonPath, IsTakenFromTheBeginning) {
    for (const char *text : {"camera", "camera.look_at", "spheres[3].radius", "planes[0].normal[2]"}) {
        EXPECT_EQ(path_text(path_of(text)), text);
    }
    for (const auto &[text, rest] : {std::pair{"a.b = -1: must be > 0", " = -1: must be > 0"},
                                     {"a.b * c", " * c"},
                                     {"... and 5 more", "... and 5 more"},
                                     {"a[x]", "[x]"},
                                     {"a[1", "[1"},
                                     {"a.", "."},
                                     {"[1]", "[1]"},
                                     {"a[-1]", "[-1]"},
                                     {"a[]", "[]"},
                                     {"", ""}}) {
        std::string_view view = text;
        take_path(view);
        EXPECT_EQ(view, rest) << text;
    }
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
    EXPECT_EQ(find_line(text, {}), 1U);
    EXPECT_EQ(find_line(text, path_of("a")), 2U);
    EXPECT_EQ(find_line(text, path_of("list")), 3U);
    EXPECT_EQ(find_line(text, path_of("list[0]")), 3U);
    EXPECT_EQ(find_line(text, path_of("list[1]")), 4U); // though the parser has read the line's end by then
    EXPECT_EQ(find_line(text, path_of("list[2]")), 5U);
    EXPECT_EQ(find_line(text, path_of("list[2][1].x")), 6U);
    EXPECT_EQ(find_line(text, {{"odd name", 0, false}, {"a", 0, false}}), 8U); // and not the first "a"
}

TEST(JsonPath, WhatIsNotThereHasTheLineOfWhatIsAroundIt) {
    constexpr std::string_view text = "{\n\"list\": [1,\n{\"x\": 1}\n]}";
    EXPECT_EQ(find_line(text, path_of("list[1].y")), 3U);
    EXPECT_EQ(find_line(text, path_of("list[7].y")), 2U);
    EXPECT_EQ(find_line(text, path_of("other.y")), std::nullopt);
}

TEST(JsonPath, TheSecondOfTwo) {
    constexpr std::string_view text = "{\n\"a\": 1,\n\"a\": 2}";
    EXPECT_EQ(find_line(text, path_of("a")), 2U);
    EXPECT_EQ(find_line(text, path_of("a"), 2), 3U);
}

TEST(JsonPath, BrokenTextIsReadAsFarAsItGoes) {
    EXPECT_EQ(find_line("", {}), 1U);
    EXPECT_EQ(find_line("{\n\"a\": [\n1e999", path_of("a[0]")), 3U);
}

} // namespace
