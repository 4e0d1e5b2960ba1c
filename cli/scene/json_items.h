// Parses JSON text whose root is an object of sections, each an object or array of small items. Items are handed out
// one at a time, so that a file of a million spheres never stands in memory as a tree.
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

    // A member of the root begins; kind is what it is. Places are valid during the call.
    virtual void begin_section(const JsonPlace &place, nlohmann::json::value_t kind) = 0;

    // One member or element of the section that began last.
    virtual void item(const JsonPlace &place, const nlohmann::json &value) = 0;
};

// Throws Failure(ExitCode::scene) for syntax errors, as "file:line:column: ...", and JsonRefusal for what is legal
// syntax but has no single meaning here: duplicate keys, numbers beyond double, a root that is no object. Comments are
// allowed.
void parse_json_items(std::string_view text, const std::string &file_name, JsonItemHandler &handler);

// The line, from 1, of the member's key or of the element at that path, or of the innermost value around it that the
// text has as far as it can be parsed; nothing if it has not even the first step. Of a key that is given again it is
// the last one.
std::optional<std::size_t> line_of(std::string_view text, const JsonPath &path);

} // namespace cli
