#include "cli/base/json_path.h"

#include "cli/base/number.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>

namespace cli {
namespace {

using nlohmann::json;

bool is_identifier_letter(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

// How many of the first letters make an identifier.
std::size_t identifier_length(std::string_view text) {
    return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_identifier_letter) - text.begin());
}

// The inside of brackets: a number, or a key in quotes.
std::optional<JsonStep> parse_bracketed(std::string_view text) {
    if (text.starts_with('"')) {
        const json key = json::parse(text, nullptr, false);
        return key.is_string() ? std::optional(JsonStep{key.get<std::string>(), 0, false}) : std::nullopt;
    }
    const auto index = parse_number<std::size_t>(text);
    return index ? std::optional(JsonStep{{}, *index, true}) : std::nullopt;
}

// The length of what is between brackets, of a text behind the first of them; nothing without the second one.
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

} // namespace cli
