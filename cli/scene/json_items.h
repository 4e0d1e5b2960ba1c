// Parses JSON text whose root is an object of sections, each an object or array of small items. Items are handed out
// one at a time, so that a file of a million spheres never stands in memory as a tree. The lines of values are kept.
#pragma once

#include "cli/base/json_path.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// Which values stand on which lines of a text. Values on the line of what is around them take no memory.
class JsonLines {
public:
    using Place = std::uint64_t; // a hash of the steps from the root
    static constexpr Place root = 0;
    static Place member(Place parent, std::string_view key);
    static Place element(Place parent, std::size_t index);

    void add(Place place, std::size_t line) { lines_.push_back({place, line}); }

    // The line, from 1, of the member's key or of the element, or of the innermost value around it that the text has;
    // nothing if it has not even the first step. Of a key that is given again it is the last one.
    std::optional<std::size_t> find(const JsonPath &path) const;

private:
    struct Line {
        Place place;
        std::size_t number;
    };
    std::vector<Line> lines_;
};

class JsonItemHandler {
public:
    virtual ~JsonItemHandler() = default;

    // A member of the root begins; kind is what it is. Places are valid during the call.
    virtual void begin_section(const JsonPlace &place, nlohmann::json::value_t kind) = 0;

    // One member or element of the section that began last.
    virtual void item(const JsonPlace &place, const nlohmann::json &value) = 0;
};

// lines: gets those of all values, as far as the text is read. Throws Failure(ExitCode::scene) for syntax errors, as
// "file:line:column: ...", and JsonRefusal for what is legal syntax but has no single meaning here: duplicate keys,
// numbers beyond double, a root that is no object. Comments are allowed.
void parse_json_items(std::string_view text, const std::string &file_name, JsonLines &lines, JsonItemHandler &handler);

} // namespace cli
