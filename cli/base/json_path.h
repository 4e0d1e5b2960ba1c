// Paths to values in JSON text, how they are written, and refusals of what they lead to.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cli {

// From a value to one inside it: a member of an object, or an element of an array.
struct JsonStep {
    std::string key; // empty in arrays
    std::size_t index = 0;
    bool in_array = false;

    bool operator==(const JsonStep &) const = default;
};

using JsonPath = std::vector<JsonStep>; // from the root

// spheres[3].radius, materials["blue ball"].diffuse[0]: a key that is no identifier is quoted.
std::string path_text(const JsonPath &path);

// The path that a text begins with, as path_text writes it, and what follows it; nothing if it begins with none.
struct ParsedPath {
    JsonPath path;
    std::string_view rest;
};
std::optional<ParsedPath> parse_path(std::string_view text);

// Whether the value of the one path is, or is within, that of the other.
bool is_within(const JsonPath &path, const JsonPath &outer);

// Where a value stands, as a chain towards the root, so that a path is made only for messages: a scene may have
// millions of values.
struct JsonPlace {
    const JsonPlace *parent = nullptr;
    std::string_view key; // empty at the root and in arrays
    std::size_t index = 0;
    bool in_array = false;

    JsonPlace member(std::string_view name) const { return {this, name, 0, false}; }
    JsonPlace element(std::size_t number) const { return {this, {}, number, true}; }

    JsonPath path() const; // from the root
};

// A value that breaks a rule. The caller that has the text adds file and line.
struct JsonRefusal : std::runtime_error {
    JsonRefusal(JsonPath place, const std::string &rule) : std::runtime_error(rule), path(std::move(place)) {}

    JsonPath path;
};

// Throws JsonRefusal.
[[noreturn]] inline void refuse(const JsonPlace &place, const std::string &rule) {
    throw JsonRefusal(place.path(), rule);
}

} // namespace cli
