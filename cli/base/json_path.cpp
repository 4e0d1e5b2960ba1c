#include "cli/base/json_path.h"

#include "cli/base/number.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

namespace cli {
namespace {

using nlohmann::json;

bool is_identifier_letter(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

// Walks over text and tells how far the parser has come.
class CountingIterator {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char *;
    using reference = const char &;

    CountingIterator(const char *position, const char *&reached) : position_(position), reached_(&reached) {}

    reference operator*() const { return *position_; }
    CountingIterator &operator++() {
        *reached_ = ++position_;
        return *this;
    }
    CountingIterator operator++(int) {
        const CountingIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const CountingIterator &other) const { return position_ == other.position_; }

private:
    const char *position_;
    const char **reached_;
};

class LineFinder : public nlohmann::json_sax<json> {
public:
    LineFinder(std::string_view text, const JsonPath &path, std::size_t occurrence) :
        text_(text),
        path_(path),
        left_(occurrence),
        reached_(text.data()) {}

    std::optional<std::size_t> find() {
        constexpr bool strict = true;
        constexpr bool ignore_comments = true;
        const char *const end = text_.data() + text_.size();
        json::sax_parse(CountingIterator(text_.data(), reached_), CountingIterator(end, reached_), this,
                        json::input_format_t::json, strict, ignore_comments);
        return line_;
    }

    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t &) override { return value(); }
    bool string(string_t &) override { return value(); }
    bool binary(binary_t &) override { return false; } // JSON text has none
    bool start_object(std::size_t) override { return begin(false); }
    bool start_array(std::size_t) override { return begin(true); }
    bool end_object() override { return end(); }
    bool end_array() override { return end(); }
    bool key(string_t &name) override {
        levels_.back().key = name;
        return look();
    }
    // A number that is too large for double is a parse error, and yet a value that has a line.
    bool parse_error(std::size_t, const std::string &, const json::exception &) override {
        value();
        return false;
    }

private:
    // Members are looked at with their key, elements when they begin.
    bool value() {
        if (levels_.empty() || !levels_.back().in_array)
            return levels_.empty() ? look() : true;
        ++levels_.back().index;
        return look();
    }

    bool begin(bool is_array) {
        const bool go_on = value();
        levels_.push_back({{}, is_array ? static_cast<std::size_t>(-1) : 0, is_array}); // the first element makes it 0
        return go_on;
    }

    bool end() {
        levels_.pop_back();
        return true;
    }

    // Whether the search goes on.
    bool look() {
        const std::size_t depth = levels_.size();
        const bool leads_there =
            depth >= depth_ && depth <= path_.size() && std::equal(levels_.begin(), levels_.end(), path_.begin());
        if (!leads_there)
            return true;
        depth_ = depth;
        if (depth > 0 || path_.empty()) {
            // Without the last character read: of a number the parser has read one more, maybe the end of the line.
            const char *const last = reached_ == text_.data() ? reached_ : reached_ - 1;
            line_ = static_cast<std::size_t>(std::count(text_.data(), last, '\n')) + 1;
        }
        return depth < path_.size() || --left_ > 0;
    }

    std::string_view text_;
    const JsonPath &path_;
    std::size_t left_;
    const char *reached_;
    JsonPath levels_; // open values, each with the step to what is inside it now
    std::size_t depth_ = 0;
    std::optional<std::size_t> line_;
};

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

std::optional<std::size_t> find_line(std::string_view text, const JsonPath &path, std::size_t occurrence) {
    return LineFinder(text, path, occurrence).find();
}

} // namespace cli
