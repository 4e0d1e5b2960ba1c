// Parses JSON text whose root is an object of sections, each an object or array of small items. Items are handed out
// one at a time, so that a file of a million spheres never stands in memory as a tree.
#pragma once

#include "cli/base/json_value.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace cli {

class JsonSectionHandler {
public:
    virtual ~JsonSectionHandler() = default;

    // A member of the root begins; kind is what it is. Places are valid during the call.
    virtual void begin_section(const JsonPlace &place, nlohmann::json::value_t kind) = 0;

    // One member or element of the section that began last.
    virtual void item(const JsonPlace &place, const nlohmann::json &value) = 0;
};

// Throws Failure(ExitCode::scene) for syntax errors, as "file:line:column: ...", and JsonRefusal for what is legal
// syntax but has no single meaning here: duplicate keys, numbers beyond double, a root that is no object. Comments are
// allowed.
void parse_json_sections(std::string_view text, const std::string &file_name, JsonSectionHandler &handler);

} // namespace cli
