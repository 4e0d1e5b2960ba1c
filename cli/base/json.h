// JSON: paths, rules of values (which give check, refusal and JSON Schema), reports.
#pragma once

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cli {

// A member of an object, or an element of an array.
struct JsonStep {
    std::string key; // empty in arrays
    std::size_t index = 0;
    bool in_array = false;

    bool operator==(const JsonStep &) const = default;
};

using JsonPath = std::vector<JsonStep>; // from the root

// spheres[3].radius, materials["blue ball"].diffuse[0]: only identifiers are not quoted.
std::string path_text(const JsonPath &path);

// A path at the beginning of a text, and the rest; empty without one.
struct ParsedPath {
    JsonPath path;
    std::string_view rest;
};
std::optional<ParsedPath> parse_path(std::string_view text);

// Equal or inside.
bool is_within(const JsonPath &path, const JsonPath &outer);

// Links towards the root. Paths are made for messages only, because a scene may have millions of values.
struct JsonPlace {
    const JsonPlace *parent = nullptr;
    std::string_view key; // empty at the root and in arrays
    std::size_t index = 0;
    bool in_array = false;

    JsonPlace member(std::string_view name) const { return {this, name, 0, false}; }
    JsonPlace element(std::size_t number) const { return {this, {}, number, true}; }

    JsonPath path() const;
};

// The caller adds file and line.
struct JsonRefusal : std::runtime_error {
    JsonRefusal(JsonPath place, const std::string &rule) :
        std::runtime_error(rule),
        path(place),
        cause(std::move(place)) {}

    JsonPath path;
    JsonPath cause; // gives the line of the message: the value, or an unknown key in it
};

[[noreturn]] inline void refuse(const JsonPlace &place, const std::string &rule) {
    throw JsonRefusal(place.path(), rule);
}

// Bytes of file and device names that are not UTF-8 become U+FFFD.
inline std::string json_text(const nlohmann::ordered_json &value) {
    return value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

// JSON has no infinity: null means unknown or beyond all numbers.
inline nlohmann::ordered_json number_or_null(double number) {
    return std::isfinite(number) ? nlohmann::ordered_json(number) : nlohmann::ordered_json(nullptr);
}

struct ValueRule {
    enum class Form {
        number,
        whole_number,   // from 0 on, also written as 1e3
        number_or_auto, // "auto"
        boolean,
        text,
        name,    // one of `names`
        numbers, // an array of `count`
        color    // R, G and B, or one number for all, float32
    };
    Form form = Form::number;
    double least = -std::numeric_limits<double>::infinity(); // of each number
    double largest = std::numeric_limits<double>::infinity();
    bool excludes_largest = false;
    bool may_be_negative = false; // a length: 0 and the negative range are valid, too
    bool is_of_library = false;   // the library checks the range, and reports all violations together
    bool is_float = false;        // float32
    bool excludes_zeros = false;  // not all numbers of the array may be 0
    std::size_t count = 0;
    std::string_view kind = {}; // of the names, for messages
    std::span<const std::string_view> names = {};
    std::string_view unit = {};
};

inline constexpr ValueRule natural_number{
    .form = ValueRule::Form::whole_number, .least = 0.0, .largest = std::numeric_limits<std::uint32_t>::max()};
inline constexpr ValueRule positive_number{
    .form = ValueRule::Form::whole_number, .least = 1.0, .largest = std::numeric_limits<std::uint32_t>::max()};
inline constexpr ValueRule seconds_rule{.least = 0.01, .largest = 1e9}; // thirty years

void check(const ValueRule &rule, const nlohmann::json &value, const JsonPlace &place);

// "a number", "an array" ...
std::string json_kind(nlohmann::json::value_t kind);

// The user's own text, or its kind if long.
std::string shown(const nlohmann::json &value);

std::uint64_t largest_whole_number(const ValueRule &rule);

[[noreturn]] void refuse_unknown_key(const JsonPlace &object, std::string_view key,
                                     std::span<const std::string_view> known);

} // namespace cli
