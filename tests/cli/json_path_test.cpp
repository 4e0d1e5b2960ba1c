// Tests of cli/json_path, and of the lines that cli/json_items keeps.
#include "cli/scene/json_items.h"

#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>
#include <string>
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

struct IgnoringHandler : cli::JsonItemHandler {
    void begin_section(const cli::JsonPlace &, nlohmann::json::value_t) override {}
    void item(const cli::JsonPlace &, const nlohmann::json &) override {}
};

// As far as the text can be read.
std::optional<std::size_t> find_line(std::string_view text, const JsonPath &path) {
    cli::JsonLines lines;
    IgnoringHandler handler;
    try {
        cli::parse_json_items(text, "", lines, handler);
    } catch (const std::runtime_error &) {
    }
    return lines.find(path);
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
    EXPECT_EQ(find_line(text, {}), 1U);
    EXPECT_EQ(find_line(text, {key("a")}), 2U);
    EXPECT_EQ(find_line(text, {key("list")}), 3U);
    EXPECT_EQ(find_line(text, {key("list"), element(0)}), 3U);
    EXPECT_EQ(find_line(text, {key("list"), element(1)}), 4U); // though the parser has read the line's end by then
    EXPECT_EQ(find_line(text, {key("list"), element(2)}), 5U);
    EXPECT_EQ(find_line(text, {key("list"), element(2), element(1), key("x")}), 6U);
    EXPECT_EQ(find_line(text, {{"odd name", 0, false}, {"a", 0, false}}), 8U); // and not the first "a"
}

TEST(JsonPath, WhatIsNotThereHasTheLineOfWhatIsAroundIt) {
    constexpr std::string_view text = "{\n\"list\": [1,\n{\"x\": 1}\n]}";
    EXPECT_EQ(find_line(text, {key("list"), element(1), key("y")}), 3U);
    EXPECT_EQ(find_line(text, {key("list"), element(7), key("y")}), 2U);
    EXPECT_EQ(find_line(text, {key("other"), key("y")}), std::nullopt);
}

TEST(JsonPath, TheSecondOfTwo) {
    constexpr std::string_view text = "{\n\"a\": 1,\n\"a\": 2}";
    EXPECT_EQ(find_line(text, {key("a")}), 3U);
}

TEST(JsonPath, BrokenTextIsReadAsFarAsItGoes) {
    EXPECT_EQ(find_line("{\n\"a\": [\n1e999", {key("a"), element(0)}), 3U);
}

} // namespace
