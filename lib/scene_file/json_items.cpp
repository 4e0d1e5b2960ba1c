#include "lib/scene_file/json_items.h"

#include "lib/base/error.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <set>
#include <vector>

namespace pt {
namespace {

using nlohmann::json;

class TellingIterator {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char *;
    using reference = const char &;

    TellingIterator(const char *position, const char *&reached) : position_(position), reached_(&reached) {}

    reference operator*() const { return *position_; }
    TellingIterator &operator++() {
        *reached_ = ++position_;
        return *this;
    }
    bool operator==(const TellingIterator &other) const { return position_ == other.position_; }

private:
    const char *position_;
    const char **reached_;
};

class ItemParser {
public:
    // Also finds the line of the value at `wanted`.
    ItemParser(JsonItemHandler &handler, const JsonPath &wanted) :
        handler_(handler),
        wanted_(wanted),
        line_depth_(wanted.empty() ? 0 : 1) {}

    void parse(std::string_view text) {
        constexpr bool throws = true;
        constexpr bool ignore_comments = true;
        begin_ = reached_ = text.data();
        const auto take_next = [&](int, json::parse_event_t event, const json &parsed) { return take(event, parsed); };
        try {
            [[maybe_unused]] const json empty_sections =
                json::parse(TellingIterator(begin_, reached_), TellingIterator(begin_ + text.size(), reached_),
                            take_next, throws, ignore_comments);
        } catch (const json::out_of_range &error) {
            constexpr int number_overflow = 406;
            if (error.id != number_overflow)
                throw;
            refuse_overflow(error.what());
        }
    }

    std::optional<std::size_t> line() const { return line_; }

    // Returns the position of a missing comma, if there is one. `wrong_end` is the end of the first wrong token.
    std::optional<std::size_t> missing_comma(std::string_view text, std::size_t wrong_end) const {
        constexpr std::string_view blanks = " \t\r\n";
        constexpr std::string_view ends_of_values = "\"{[0123456789el";
        const bool has_another = !levels_.empty() && wrong_end > 0 && wrong_end <= text.size() &&
                                 ends_of_values.find(text[wrong_end - 1]) != std::string_view::npos;
        if (!has_another || !after_value_)
            return std::nullopt;
        const auto end = static_cast<std::size_t>(value_end_ - begin_);
        return text.find_last_not_of(blanks, end - 1) + 1;
    }

private:
    struct Level {
        JsonStep step;
        std::set<std::string> keys{};
    };

    static constexpr std::size_t section_depth = 1;
    static constexpr std::size_t element_depth = 2;

    // The parser's callback. Returns false to discard the value.
    bool take(json::parse_event_t event, const json &parsed) {
        const bool is_end = event == json::parse_event_t::array_end || event == json::parse_event_t::object_end;
        after_value_ = is_end || event == json::parse_event_t::value;
        value_end_ = reached_ - (parsed.is_number() ? 1 : 0); // the parser has read one more character
        switch (event) {
        case json::parse_event_t::object_start:
        case json::parse_event_t::array_start:
            begin(event == json::parse_event_t::array_start);
            return true;
        case json::parse_event_t::key:
            enter_member(parsed.get_ref<const std::string &>());
            return true;
        case json::parse_event_t::value:
            enter_value(parsed.type());
            return hand_out(parsed);
        default:
            levels_.pop_back();
            return hand_out(parsed);
        }
    }

    [[noreturn]] void refuse_overflow(const std::string &what) {
        enter_value(json::value_t::number_float);
        const std::size_t quote = what.find('\'');
        throw JsonRefusal(path(),
                          "the number " + what.substr(quote + 1, what.rfind('\'') - quote - 1) + " is too large");
    }

    JsonPath path() const {
        JsonPath path;
        for (const Level &level : levels_)
            path.push_back(level.step);
        return path;
    }

    // Stores the line if this is the wanted value. The last character read may be the line end after a number, so it
    // does not count.
    void enter() {
        const bool leads_there =
            levels_.size() >= line_depth_ && levels_.size() <= wanted_.size() &&
            std::equal(levels_.begin(), levels_.end(), wanted_.begin(),
                       [](const Level &level, const JsonStep &step) { return level.step == step; });
        if (!leads_there)
            return;
        line_depth_ = levels_.size();
        line_ = 1 + static_cast<std::size_t>(std::count(begin_, std::max(begin_, reached_ - 1), '\n'));
    }

    void enter_member(const std::string &name) {
        Level &level = levels_.back();
        level.step.key = name;
        enter();
        if (!level.keys.insert(name).second)
            throw JsonRefusal(path(), "is given twice");
    }

    // A member has the line of its key. An element has the line where it begins.
    void enter_value(json::value_t kind) {
        if (levels_.empty()) {
            enter();
            if (kind != json::value_t::object)
                refuse({}, "must contain an object, is " + json_kind(kind));
        } else if (JsonStep &step = levels_.back().step; step.in_array) {
            ++step.index;
            enter();
        }
        if (levels_.size() == section_depth) {
            const JsonPlace root;
            handler_.begin_section(root.member(levels_[0].step.key), kind);
        }
    }

    void begin(bool is_array) {
        enter_value(is_array ? json::value_t::array : json::value_t::object);
        levels_.push_back({{{}, is_array ? static_cast<std::size_t>(-1) : 0, is_array}});
    }

    // Passes items to the handler and discards them.
    bool hand_out(const json &value) {
        if (levels_.size() != element_depth)
            return true;
        const JsonPlace root;
        const JsonPlace section = root.member(levels_[0].step.key);
        const JsonStep &step = levels_[1].step;
        handler_.item(step.in_array ? section.element(step.index) : section.member(step.key), value);
        return false;
    }

    JsonItemHandler &handler_;
    const JsonPath &wanted_;
    const char *begin_ = nullptr;
    const char *reached_ = nullptr;
    const char *value_end_ = nullptr;
    bool after_value_ = false;
    std::vector<Level> levels_;
    std::size_t line_depth_;
    std::optional<std::size_t> line_;
};

// Returns line and column after this text, for example "3:14". Both count from 1; columns are in bytes.
std::string line_and_column(std::string_view before) {
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t line_start = before.rfind('\n') + 1;
    return std::to_string(line) + ":" + std::to_string(before.size() - line_start + 1);
}

// Rewords the parser's message. error.byte includes the wrong character.
Error error_of(const json::parse_error &error, const ItemParser &parser, std::string_view text,
               const std::string &file_name) {
    if (const auto comma = parser.missing_comma(text, error.byte))
        return {PT_ERROR_INVALID_SCENE,
                file_name + ":" + line_and_column(text.substr(0, *comma)) + ": syntax error: a comma is missing"};
    const std::string_view before =
        text.substr(0, std::min(error.byte, text.size() + 1) - std::min<std::size_t>(error.byte, 1));
    const std::string_view what = error.what();
    const std::size_t reason = what.find(": ", std::min(what.find("column "), what.size()));
    return {PT_ERROR_INVALID_SCENE, file_name + ":" + line_and_column(before) + ": " +
                                        std::string(reason == std::string_view::npos ? what : what.substr(reason + 2))};
}

} // namespace

void parse_json_items(std::string_view text, const std::string &file_name, JsonItemHandler &handler) {
    if (text.empty())
        throw Error(PT_ERROR_INVALID_SCENE, file_name + ":1:1: syntax error: the file is empty");
    const JsonPath none;
    ItemParser parser(handler, none);
    try {
        parser.parse(text);
    } catch (const json::parse_error &error) {
        throw error_of(error, parser, text, file_name);
    }
}

std::string_view require_text(std::string_view contents, const std::string &file_name) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (const std::size_t zero = contents.find('\0'); zero != std::string_view::npos) {
        throw Error(PT_ERROR_INVALID_SCENE, file_name + ":" + line_and_column(contents.substr(0, zero)) +
                                                ": a NUL byte: this is not UTF-8 text");
    }
    contents.remove_prefix(contents.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    return contents;
}

std::optional<std::size_t> line_of(std::string_view text, const JsonPath &path) {
    struct : JsonItemHandler {
        void begin_section(const JsonPlace &, json::value_t) override {}
        void item(const JsonPlace &, const json &) override {}
    } nobody;
    ItemParser parser(nobody, path);
    try {
        parser.parse(text);
    } catch (const std::exception &) {
    }
    return parser.line();
}

} // namespace pt
