// Paths to values in JSON text: how they are written in messages, and which line of the text they lead to. Lines are
// looked up for messages alone, by parsing the text once more: a scene may have millions of values.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
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

// The line, from 1, of the member's key or of the element, or of the innermost value around it that the text has;
// nothing if it has not even the first step. Where a key is given several times, occurrence says which one counts.
std::optional<std::size_t> find_line(std::string_view text, const JsonPath &path, std::size_t occurrence = 1);

} // namespace cli
