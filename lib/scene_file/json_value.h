#pragma once

#include <nlohmann/json.hpp>

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

namespace pt {

struct JsonStep {
    std::string key; // empty in arrays
    std::size_t index = 0;
    bool in_array = false;

    bool operator==(const JsonStep &) const = default;
};

using JsonPath = std::vector<JsonStep>;

// Returns for example spheres[3].radius or materials["blue ball"].diffuse[0].
std::string path_text(const JsonPath &path);

// The path is empty if the text does not begin with a path.
struct ParsedPath {
    JsonPath path;
    std::string_view rest;
};
std::optional<ParsedPath> parse_path(std::string_view text);

bool is_within(const JsonPath &path, const JsonPath &outer);

// A linked list to the root. Full paths are made only for messages, because scenes may have millions of values.
struct JsonPlace {
    const JsonPlace *parent = nullptr;
    std::string_view key; // empty at the root and in arrays
    std::size_t index = 0;
    bool in_array = false;

    JsonPlace member(std::string_view name) const { return {this, name, 0, false}; }
    JsonPlace element(std::size_t number) const { return {this, {}, number, true}; }

    JsonPath path() const;
};

struct JsonRefusal : std::runtime_error {
    JsonRefusal(JsonPath place, const std::string &rule) :
        std::runtime_error(rule),
        path(place),
        cause(std::move(place)) {}

    JsonPath path;
    JsonPath cause; // the value or unknown key whose line is in the message
};

[[noreturn]] inline void refuse(const JsonPlace &place, const std::string &rule) {
    throw JsonRefusal(place.path(), rule);
}

struct ValueRule {
    enum class Form {
        number,
        whole_number,
        number_or_auto,
        boolean,
        text,
        name,
        numbers,
        color // float32: three numbers, or one for all
    };
    Form form = Form::number;
    double least = -std::numeric_limits<double>::infinity();
    double largest = std::numeric_limits<double>::infinity();
    bool excludes_largest = false;
    bool may_be_negative = false;
    bool is_of_library = false; // libpt checks the range
    bool is_float = false;
    bool excludes_zeros = false;
    std::size_t count = 0;
    std::string_view kind = {};
    std::span<const std::string_view> names = {};
    std::string_view unit = {};
};

inline constexpr ValueRule natural_number{
    .form = ValueRule::Form::whole_number, .least = 0.0, .largest = std::numeric_limits<std::uint32_t>::max()};
inline constexpr ValueRule positive_number{
    .form = ValueRule::Form::whole_number, .least = 1.0, .largest = std::numeric_limits<std::uint32_t>::max()};
inline constexpr ValueRule seconds_rule{.least = 0.01, .largest = 1e9};

void check(const ValueRule &rule, const nlohmann::json &value, const JsonPlace &place);

std::string json_kind(nlohmann::json::value_t kind);

// Returns the user's text, or its kind if the text is long.
std::string shown(const nlohmann::json &value);

std::uint64_t largest_whole_number(const ValueRule &rule);

[[noreturn]] void refuse_unknown_key(const JsonPlace &object, std::string_view key,
                                     std::span<const std::string_view> known);

} // namespace pt
