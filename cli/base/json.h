// JSON: paths to values in text, what a value may be (rules as data, from which its check, its refusal and its JSON
// Schema follow), refusals, and the text of reports.
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

// A step from a value to one inside it: a member of an object, or an element of an array.
struct JsonStep {
    std::string key; // empty in arrays
    std::size_t index = 0;
    bool in_array = false;

    bool operator==(const JsonStep &) const = default;
};

using JsonPath = std::vector<JsonStep>; // from the root

// spheres[3].radius, materials["blue ball"].diffuse[0]: a key that is no identifier is quoted.
std::string path_text(const JsonPath &path);

// The path at the beginning of a text, as path_text writes it, and the rest of the text; nothing if there is no path.
struct ParsedPath {
    JsonPath path;
    std::string_view rest;
};
std::optional<ParsedPath> parse_path(std::string_view text);

// Whether the first path is the second one or leads to something inside it.
bool is_within(const JsonPath &path, const JsonPath &outer);

// The place of a value, as a chain of links towards the root. A path is made only for messages, since a scene may have
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

// Names of files and devices may be any bytes, but JSON is UTF-8. Whatever is not becomes U+FFFD, so that a strange
// name does not cost the figures beside it.
inline std::string json_text(const nlohmann::ordered_json &value) {
    return value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

// JSON has no infinity: null stands for an unknown error, or one beyond all numbers.
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
        color    // R, G and B, or one number for all three, float32
    };
    Form form = Form::number;
    double least = -std::numeric_limits<double>::infinity(); // of each number
    double largest = std::numeric_limits<double>::infinity();
    bool excludes_largest = false;
    bool may_be_negative = false; // a length: the negative of such a number too, and 0
    bool is_of_library = false;   // the library checks the range, and tells of all that is beyond at once
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

// Throws JsonRefusal.
void check(const ValueRule &rule, const nlohmann::json &value, const JsonPlace &place);

// `a number`, `an array` and so on, for messages.
std::string json_kind(nlohmann::json::value_t kind);

// The value as the user wrote it, or what kind of value it is if that would be long.
std::string shown(const nlohmann::json &value);

// The largest number of a rule for whole numbers.
std::uint64_t largest_whole_number(const ValueRule &rule);

[[noreturn]] void refuse_unknown_key(const JsonPlace &object, std::string_view key,
                                     std::span<const std::string_view> known);

} // namespace cli
