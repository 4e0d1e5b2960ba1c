// What a value of a scene file may be: rules as data, from which its check, its refusal and its JSON Schema follow.
#pragma once

#include "cli/base/json_path.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace cli {

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

// A value as the user wrote it, or what it is if that would be long.
std::string shown(const nlohmann::json &value);

// The largest number of a rule for whole numbers.
std::uint64_t largest_whole_number(const ValueRule &rule);

[[noreturn]] void refuse_unknown_key(const JsonPlace &object, std::string_view key,
                                     std::span<const std::string_view> known);

} // namespace cli
