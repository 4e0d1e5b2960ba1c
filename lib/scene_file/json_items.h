// Parses JSON whose root has sections. Each section is an object or array of small items. Items are passed on one at a
// time, so a million spheres never become one tree.
#pragma once

#include "lib/scene_file/json_value.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace pt {

class JsonItemHandler {
public:
    virtual ~JsonItemHandler() = default;

    // Places are valid during the call.
    virtual void begin_section(const JsonPlace &place, nlohmann::json::value_t kind) = 0;

    // The item belongs to the last section.
    virtual void item(const JsonPlace &place, const nlohmann::json &value) = 0;
};

// Allows comments. Throws PT_ERROR_INVALID_SCENE for syntax errors ("file:line:column: ..."). Throws JsonRefusal for
// duplicate keys, numbers beyond double, and a root other than an object.
void parse_json_items(std::string_view text, const std::string &file_name, JsonItemHandler &handler);

// Removes a byte order mark. Throws PT_ERROR_INVALID_SCENE at a NUL byte.
std::string_view require_text(std::string_view contents, const std::string &file_name);

// Returns the line, from 1, of the value at the path, or of the innermost value around it, as far as the text can be
// parsed. The last of repeated keys wins.
std::optional<std::size_t> line_of(std::string_view text, const JsonPath &path);

} // namespace pt
