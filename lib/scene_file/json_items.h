// Parses JSON whose root has sections, each an object or array of small items. Hands out items one at a time, so that a
// million spheres never become one tree.
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

    // Belongs to the last section.
    virtual void item(const JsonPlace &place, const nlohmann::json &value) = 0;
};

// Allows comments. Throws PT_ERROR_INVALID_SCENE for syntax errors, "file:line:column: ...", and JsonRefusal for
// duplicate keys, numbers beyond double, and a root other than an object.
void parse_json_items(std::string_view text, const std::string &file_name, JsonItemHandler &handler);

// Removes a byte order mark. Throws PT_ERROR_INVALID_SCENE at a NUL byte.
std::string_view require_text(std::string_view contents, const std::string &file_name);

// Line, from 1, of the value at the path or the innermost one around it, where the text can be parsed. The last of
// repeated keys wins.
std::optional<std::size_t> line_of(std::string_view text, const JsonPath &path);

} // namespace pt
