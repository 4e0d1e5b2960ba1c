#include "cli/base/json_value.h"

#include "cli/base/suggestion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cli {
namespace {

using nlohmann::json;

// A value as the user wrote it, or what it is if that would be long.
std::string shown(const json &value) {
    constexpr std::size_t longest = 40;
    if (value.is_structured() || value.is_null())
        return json_kind(value.type());
    const std::string text = value.dump();
    return text.size() > longest ? json_kind(value.type()) : text;
}

[[noreturn]] void refuse_value(const json &value, const JsonPlace &place, const std::string &rule) {
    refuse(place, rule + ", is " + shown(value));
}

template <std::size_t Count>
std::array<double, Count> read_numbers(const json &value, const JsonPlace &place) {
    const std::string rule = "must be an array of " + std::to_string(Count) + " numbers";
    if (!value.is_array())
        refuse_value(value, place, rule);
    if (value.size() != Count)
        refuse(place, rule + ", has " + std::to_string(value.size()));
    std::array<double, Count> numbers{};
    for (std::size_t i = 0; i < Count; ++i)
        numbers[i] = read_number(value[i], place.element(i));
    return numbers;
}

} // namespace

JsonPath JsonPlace::path() const {
    JsonPath path;
    for (const JsonPlace *step = this; step->parent != nullptr; step = step->parent)
        path.push_back({std::string(step->key), step->index, step->in_array});
    std::reverse(path.begin(), path.end());
    return path;
}

void refuse(const JsonPlace &place, const std::string &rule) {
    throw JsonRefusal(place.path(), rule);
}

std::string json_kind(json::value_t kind) {
    switch (kind) {
    case json::value_t::null:
        return "null";
    case json::value_t::object:
        return "an object";
    case json::value_t::array:
        return "an array";
    case json::value_t::string:
        return "a string";
    case json::value_t::boolean:
        return "a boolean";
    default:
        return "a number";
    }
}

double read_number(const json &value, const JsonPlace &place) {
    if (!value.is_number())
        refuse_value(value, place, "must be a number");
    return value.get<double>();
}

float read_float(const json &value, const JsonPlace &place) {
    const double number = read_number(value, place);
    if (std::abs(number) > static_cast<double>(std::numeric_limits<float>::max()))
        refuse_value(value, place, "must lie in the range of 32-bit floating point numbers");
    return static_cast<float>(number);
}

std::uint64_t read_whole_number(const json &value, const JsonPlace &place, std::uint64_t smallest,
                                std::uint64_t largest) {
    const std::string rule =
        "must be a whole number from " + std::to_string(smallest) + " to " + std::to_string(largest);
    std::uint64_t number = 0;
    if (value.is_number_unsigned()) {
        number = value.get<std::uint64_t>();
    } else if (value.is_number_float()) {
        // 1e3 is a whole number too. Numbers from 2^64 on reach this branch and have no such conversion.
        const double real = value.get<double>();
        if (!(real >= 0.0 && real < 0x1p64 && real == std::floor(real)))
            refuse_value(value, place, rule);
        number = static_cast<std::uint64_t>(real);
    } else {
        refuse_value(value, place, rule);
    }
    if (number < smallest || number > largest)
        refuse_value(value, place, rule);
    return number;
}

bool read_boolean(const json &value, const JsonPlace &place) {
    if (!value.is_boolean())
        refuse_value(value, place, "must be true or false");
    return value.get<bool>();
}

std::string_view read_text(const json &value, const JsonPlace &place) {
    if (!value.is_string())
        refuse_value(value, place, "must be a string");
    return value.get_ref<const std::string &>();
}

std::array<double, 3> read_vector(const json &value, const JsonPlace &place) {
    return read_numbers<3>(value, place);
}

std::array<double, 2> read_pair(const json &value, const JsonPlace &place) {
    return read_numbers<2>(value, place);
}

std::array<float, 3> read_colour(const json &value, const JsonPlace &place) {
    if (value.is_number()) {
        const float grey = read_float(value, place);
        return {grey, grey, grey};
    }
    if (!value.is_array())
        refuse_value(value, place, "must be a number or an array of 3 numbers");
    if (value.size() != 3)
        refuse(place, "must be a number or an array of 3 numbers, has " + std::to_string(value.size()));
    return {read_float(value[0], place.element(0)), read_float(value[1], place.element(1)),
            read_float(value[2], place.element(2))};
}

void refuse_unknown_key(const JsonPlace &object, std::string_view key, std::span<const std::string_view> known) {
    refuse(object, unknown_name("key", key, known));
}

JsonObject::JsonObject(const json &value, const JsonPlace &place, std::initializer_list<std::string_view> known) :
    value_(value),
    place_(place) {
    if (!value.is_object())
        refuse_value(value, place, "must be an object");
    for (const auto &member : value.items())
        if (std::find(known.begin(), known.end(), member.key()) == known.end())
            refuse_unknown_key(place, member.key(), {known.begin(), known.end()});
}

const json *JsonObject::find(const char *key) const {
    const auto found = value_.find(key);
    return found == value_.end() ? nullptr : &*found;
}

const json &JsonObject::require(const char *key) const {
    const json *found = find(key);
    if (found == nullptr)
        refuse(place_, std::string("\"") + key + "\" is missing");
    return *found;
}

} // namespace cli
