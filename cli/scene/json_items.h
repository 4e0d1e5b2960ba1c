// Parses JSON whose root is an object of sections, each an object or array of small items. Items are handed out one at
// a time, so that a file of a million spheres is never a tree in memory.
#pragma once

#include "cli/base/json.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cli {

class JsonItemHandler {
public:
    virtual ~JsonItemHandler() = default;

    // Begins a member of the root. Places are valid during the call.
    virtual void begin_section(const JsonPlace &place, nlohmann::json::value_t kind) = 0;

    // A member or element of the last section.
    virtual void item(const JsonPlace &place, const nlohmann::json &value) = 0;
};

// Throws Failure(ExitCode::scene) for syntax errors, "file:line:column: ...", and JsonRefusal for duplicate keys,
// numbers beyond double, and a root that is no object. Comments are allowed.
void parse_json_items(std::string_view text, const std::string &file_name, JsonItemHandler &handler);

// Line, from 1, of the member's key or the element at the path, or else of the innermost value around it, as far as the
// text can be parsed; nothing without even the first step. The last of repeated keys wins.
std::optional<std::size_t> line_of(std::string_view text, const JsonPath &path);

} // namespace cli
