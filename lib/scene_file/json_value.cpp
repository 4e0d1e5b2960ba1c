#include "lib/scene_file/json_value.h"

#include "lib/scene_file/names.h"
#include "lib/scene_file/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace pt {
namespace {

using nlohmann::json;

bool is_identifier_letter(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

std::size_t identifier_length(std::string_view text) {
    return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_identifier_letter) - text.begin());
}

std::optional<JsonStep> parse_bracketed(std::string_view text) {
    if (text.starts_with('"')) {
        const json key = json::parse(text, nullptr, false);
        return key.is_string() ? std::optional(JsonStep{key.get<std::string>(), 0, false}) : std::nullopt;
    }
    std::size_t index = 0;
    const char *const all = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), all, index);
    return error == std::errc{} && end == all ? std::optional(JsonStep{{}, index, true}) : std::nullopt;
}

std::optional<std::size_t> bracketed_length(std::string_view text) {
    bool is_quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == ']' && !is_quoted)
            return i;
        is_quoted = (text[i] == '"') != is_quoted;
        i += text[i] == '\\' && is_quoted ? 1 : 0;
    }
    return std::nullopt;
}

// Returns the shortest exact text. Whole numbers below 1e15 have no exponent.
std::string number_text(double number) {
    if (std::abs(number) < 1e15 && number == std::trunc(number))
        return std::to_string(static_cast<std::int64_t>(number));
    std::array<char, 32> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
    return {text.data(), end};
}

using Form = ValueRule::Form;

std::string range_text(const ValueRule &rule) {
    if (rule.is_of_library || std::isinf(rule.largest))
        return "";
    if (rule.form == Form::whole_number)
        return concat(" from ", rule.least, " to ", largest_whole_number(rule));
    return concat(" from ", rule.least, rule.excludes_largest ? " to below " : " to ", rule.largest,
                  rule.unit.empty() ? "" : " ", rule.unit);
}

std::string text_of(const ValueRule &rule) {
    switch (rule.form) {
    case Form::number:
        return "a number" + range_text(rule);
    case Form::whole_number:
        return "a whole number" + range_text(rule);
    case Form::number_or_auto:
        return "a number" + range_text(rule) + ", or \"auto\"";
    case Form::boolean:
        return "true or false";
    case Form::numbers:
        return "an array of " + std::to_string(rule.count) + " numbers";
    case Form::color:
        return "a number or an array of 3 numbers";
    default:
        return "a string";
    }
}

[[noreturn]] void refuse_value(const ValueRule &rule, const json &value, const JsonPlace &place) {
    refuse(place, "must be " + text_of(rule) + ", is " + shown(value));
}

bool is_in_range(const ValueRule &rule, double number) {
    return rule.is_of_library ||
           (number >= rule.least && number <= rule.largest && !(rule.excludes_largest && number == rule.largest));
}

bool is_whole_number(const json &value) {
    const double number = value.is_number() ? value.get<double>() : -1.0;
    return value.is_number_integer() || (value.is_number_float() && number < 0x1p64 && number == std::floor(number));
}

void check_number(const ValueRule &rule, const json &value, const JsonPlace &place) {
    if (!value.is_number())
        refuse(place, "must be a number, is " + shown(value));
    const double number = value.get<double>();
    const bool is_float = rule.is_float || rule.form == Form::color;
    if (is_float && std::abs(number) > static_cast<double>(std::numeric_limits<float>::max()))
        refuse(place, "must lie in the range of 32-bit floating point numbers, is " + shown(value));
}

void check_array(const ValueRule &rule, std::size_t count, const json &value, const JsonPlace &place) {
    if (!value.is_array())
        refuse_value(rule, value, place);
    if (value.size() != count)
        refuse(place, "must be " + text_of(rule) + ", has " + std::to_string(value.size()));
    for (std::size_t i = 0; i < count; ++i) {
        check_number(rule, value[i], place.element(i));
        if (!is_in_range(rule, value[i].get<double>()))
            refuse(place.element(i), concat("must be a number", range_text(rule), ", is ", shown(value[i])));
    }
    if (rule.excludes_zeros && std::all_of(value.begin(), value.end(), [](const json &each) { return each == 0.0; }))
        refuse(place, "must not be [0, 0, 0]");
}

} // namespace

std::optional<ParsedPath> parse_path(std::string_view text) {
    ParsedPath parsed{{}, text};
    std::string_view &rest = parsed.rest;
    while (!rest.empty()) {
        if (rest.starts_with('[')) {
            const auto length = bracketed_length(rest.substr(1));
            const auto step = length ? parse_bracketed(rest.substr(1, *length)) : std::nullopt;
            if (!step)
                return std::nullopt;
            parsed.path.push_back(*step);
            rest.remove_prefix(*length + 2);
            continue;
        }
        const bool is_first = parsed.path.empty();
        if (!is_first && !rest.starts_with('.'))
            break;
        rest.remove_prefix(is_first ? 0 : 1);
        const std::size_t length = identifier_length(rest);
        if (length == 0)
            return std::nullopt;
        parsed.path.push_back({std::string(rest.substr(0, length)), 0, false});
        rest.remove_prefix(length);
    }
    return parsed.path.empty() ? std::nullopt : std::optional(std::move(parsed));
}

bool is_within(const JsonPath &path, const JsonPath &outer) {
    return path.size() >= outer.size() && std::equal(outer.begin(), outer.end(), path.begin());
}

std::string path_text(const JsonPath &path) {
    std::string text;
    for (const JsonStep &step : path) {
        const bool is_identifier =
            !step.key.empty() && std::all_of(step.key.begin(), step.key.end(), is_identifier_letter);
        if (step.in_array)
            text.append("[").append(std::to_string(step.index)).append("]");
        else if (is_identifier)
            text.append(text.empty() ? "" : ".").append(step.key);
        else
            text.append("[").append(json(step.key).dump(-1, ' ', false, json::error_handler_t::replace)).append("]");
    }
    return text;
}

JsonPath JsonPlace::path() const {
    JsonPath path;
    for (const JsonPlace *step = this; step->parent != nullptr; step = step->parent)
        path.push_back({std::string(step->key), step->index, step->in_array});
    std::reverse(path.begin(), path.end());
    return path;
}

void check(const ValueRule &rule, const json &value, const JsonPlace &place) {
    switch (rule.form) {
    case Form::number_or_auto:
        if (value == "auto")
            return;
        [[fallthrough]];
    case Form::number:
        if (!value.is_number())
            refuse_value(rule, value, place);
        check_number(rule, value, place);
        break;
    case Form::whole_number:
        if (!is_whole_number(value))
            refuse_value(rule, value, place);
        break;
    case Form::boolean:
        if (!value.is_boolean())
            refuse_value(rule, value, place);
        return;
    case Form::text:
    case Form::name:
        if (!value.is_string())
            refuse_value(rule, value, place);
        if (const auto &name = value.get_ref<const std::string &>();
            rule.form == Form::name && std::ranges::find(rule.names, name) == rule.names.end())
            refuse(place, unknown_name(rule.kind, name, rule.names));
        return;
    case Form::color:
        if (value.is_number())
            check_number(rule, value, place);
        else
            check_array(rule, 3, value, place);
        return;
    case Form::numbers:
        check_array(rule, rule.count, value, place);
        return;
    }
    if (!is_in_range(rule, value.get<double>()))
        refuse_value(rule, value, place);
}

std::string json_kind(json::value_t kind) {
    const std::string name = json(kind).type_name();
    return kind == json::value_t::null ? name : (name[0] == 'a' || name[0] == 'o' ? "an " : "a ") + name;
}

std::string shown(const json &value) {
    constexpr std::size_t longest = 40;
    if (value.is_structured() || value.is_null())
        return json_kind(value.type());
    const std::string text = value.is_number_float() ? number_text(value.get<double>())
                                                     : value.dump(-1, ' ', false, json::error_handler_t::replace);
    return text.size() > longest ? json_kind(value.type()) : text;
}

std::uint64_t largest_whole_number(const ValueRule &rule) {
    return rule.largest < 0x1p64 ? static_cast<std::uint64_t>(rule.largest) : std::numeric_limits<std::uint64_t>::max();
}

void refuse_unknown_key(const JsonPlace &object, std::string_view key, std::span<const std::string_view> known) {
    JsonRefusal refusal(object.path(), unknown_name("key", key, known));
    refusal.cause = object.member(key).path();
    throw refusal;
}

} // namespace pt
