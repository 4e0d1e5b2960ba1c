// Parses JSON whose root has sections. Each section is an object or array of small items. Items are passed on one at a
// time, so that a million spheres are never in memory as JSON.
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

    // The item belongs to the section that begin_section() announced last.
    virtual void item(const JsonPlace &place, const nlohmann::json &value) = 0;
};

// Allows comments. Throws PT_ERROR_INVALID_SCENE for syntax errors. Throws JsonRefusal for duplicate keys, numbers
// beyond the range of double, and a root that is not an object.
void parse_json_items(std::string_view text, const std::string &file_name, JsonItemHandler &handler);

// Removes a byte order mark. Throws PT_ERROR_INVALID_SCENE at a NUL byte.
std::string_view require_text(std::string_view contents, const std::string &file_name);

// Returns the line, from 1, of the value at the path, or of the innermost existing value around it. Of repeated keys
// the last one counts. Text after a syntax error is ignored.
std::optional<std::size_t> line_of(std::string_view text, const JsonPath &path);

} // namespace pt
