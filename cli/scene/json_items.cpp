#include "cli/scene/json_items.h"

#include "cli/base/exit_code.h"
#include "cli/base/text_file.h"
#include "cli/base/value_rule.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <unordered_set>
#include <utility>

namespace cli {
namespace {

using nlohmann::json;

// How far the parser has come. It reads one character beyond a number, which may end the line: the last one that was
// read does not count.
struct Reached {
    std::size_t line = 1;
    std::size_t next_line = 1;
};

class LineCountingIterator {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char *;
    using reference = const char &;

    LineCountingIterator(const char *position, Reached &reached) : position_(position), reached_(&reached) {}

    reference operator*() const { return *position_; }
    LineCountingIterator &operator++() {
        reached_->line = reached_->next_line;
        reached_->next_line += *position_++ == '\n' ? 1 : 0;
        return *this;
    }
    bool operator==(const LineCountingIterator &other) const { return position_ == other.position_; }

private:
    const char *position_;
    Reached *reached_;
};

JsonLines::Place mixed(JsonLines::Place parent, std::uint64_t step) {
    const std::uint64_t sum = (parent + step + 1) * 0x9e3779b97f4a7c15; // splitmix64 (Steele, Lea, Flood 2014)
    return sum ^ (sum >> 31);
}

class ItemParser : public nlohmann::json_sax<json> {
public:
    ItemParser(std::string_view text, const std::string &file_name, JsonLines &lines, JsonItemHandler &handler) :
        text_(text),
        file_name_(file_name),
        lines_(lines),
        handler_(handler) {}

    void parse() {
        constexpr bool strict = true; // nothing may follow the root
        constexpr bool ignore_comments = true;
        json::sax_parse(LineCountingIterator(text_.data(), reached_),
                        LineCountingIterator(text_.data() + text_.size(), reached_), this, json::input_format_t::json,
                        strict, ignore_comments);
    }

    bool null() override { return scalar(nullptr); }
    bool boolean(bool value) override { return scalar(value); }
    bool number_integer(number_integer_t value) override { return scalar(value); }
    bool number_unsigned(number_unsigned_t value) override { return scalar(value); }
    bool number_float(number_float_t value, const string_t &) override { return scalar(value); }
    bool string(string_t &value) override { return scalar(std::move(value)); }
    bool binary(binary_t &) override { return false; } // JSON text has none
    bool start_object(std::size_t) override { return begin(json::object()); }
    bool start_array(std::size_t) override { return begin(json::array()); }
    bool end_object() override { return end(); }
    bool end_array() override { return end(); }
    bool key(string_t &name) override;
    bool parse_error(std::size_t position, const std::string &token, const json::exception &error) override;

private:
    // A value and its line.
    struct Place {
        JsonLines::Place hash = JsonLines::root;
        std::size_t line = 0;
    };

    // An array or object that is open, and the step to what is inside it now.
    struct Level {
        Place place;
        JsonStep step;
    };

    // Open levels before the value: 0 for the root, 1 for a section, 2 for an item.
    static constexpr std::size_t section_depth = 1;
    static constexpr std::size_t element_depth = 2;

    bool scalar(json value);
    bool begin(json value);
    bool end();
    json *add(json value);
    void enter_value();
    void enter(JsonLines::Place hash);
    void hand_out();
    JsonPath path() const;

    std::string_view text_;
    const std::string &file_name_;
    JsonLines &lines_;
    JsonItemHandler &handler_;
    Reached reached_;
    std::vector<Level> levels_;
    Place value_; // that began last
    // Keys met in the root and in the present section. Items are trees, which know their keys.
    std::array<std::unordered_set<std::string>, 2> names_;
    json item_;
    std::vector<json *> open_; // the item and, inside it, the arrays and objects not yet closed
};

JsonPath ItemParser::path() const {
    JsonPath path;
    for (const Level &level : levels_)
        path.push_back(level.step);
    return path;
}

void ItemParser::enter(JsonLines::Place hash) {
    value_ = {hash, reached_.line};
    if (levels_.size() <= section_depth || value_.line != levels_.back().place.line)
        lines_.add(hash, value_.line);
}

// A member has a line since its key was read. Array elements have no such event: a value that begins is the next one.
void ItemParser::enter_value() {
    if (levels_.empty()) {
        enter(JsonLines::root);
    } else if (JsonStep &step = levels_.back().step; step.in_array) {
        ++step.index;
        enter(JsonLines::element(levels_.back().place.hash, step.index));
    }
}

bool ItemParser::key(string_t &name) {
    levels_.back().step.key = name;
    enter(JsonLines::member(levels_.back().place.hash, name));
    const std::size_t depth = levels_.size() - 1;
    const bool fresh = depth < names_.size() ? names_[depth].insert(name).second : !open_.back()->contains(name);
    if (!fresh)
        throw JsonRefusal(path(), "is given twice");
    return true;
}

void ItemParser::hand_out() {
    const JsonPlace root;
    const JsonPlace section = root.member(levels_[0].step.key);
    const JsonStep &step = levels_[1].step;
    handler_.item(step.in_array ? section.element(step.index) : section.member(step.key), item_);
}

// Puts a value into the section or item that is open. Returns where it is kept: nullptr for the root and for sections.
json *ItemParser::add(json value) {
    enter_value();
    if (levels_.empty()) {
        if (!value.is_object())
            refuse({}, "must contain an object, is " + json_kind(value.type()));
        return nullptr;
    }
    if (levels_.size() == section_depth) {
        names_[section_depth].clear();
        const JsonPlace root;
        handler_.begin_section(root.member(levels_[0].step.key), value.type());
        return nullptr;
    }
    if (levels_.size() == element_depth) {
        item_ = std::move(value);
        return &item_;
    }
    json &parent = *open_.back();
    if (parent.is_array()) {
        parent.push_back(std::move(value));
        return &parent.back();
    }
    return &*parent.emplace(levels_.back().step.key, std::move(value)).first;
}

bool ItemParser::scalar(json value) {
    if (add(std::move(value)) == &item_)
        hand_out();
    return true;
}

bool ItemParser::begin(json value) {
    const bool is_array = value.is_array();
    if (json *added = add(std::move(value)))
        open_.push_back(added);
    levels_.push_back({value_, {{}, is_array ? static_cast<std::size_t>(-1) : 0, is_array}}); // the first makes it 0
    return true;
}

bool ItemParser::end() {
    levels_.pop_back();
    if (!open_.empty()) {
        open_.pop_back();
        if (open_.empty())
            hand_out();
    }
    return true;
}

// position counts the characters read so far, the wrong one included.
bool ItemParser::parse_error(std::size_t position, const std::string &token, const json::exception &error) {
    constexpr int number_overflow = 406; // the library's documented id
    if (error.id == number_overflow) {
        enter_value();
        throw JsonRefusal(path(), "the number " + token + " is too large");
    }
    const std::string_view before =
        text_.substr(0, std::min(position, text_.size() + 1) - std::min<std::size_t>(position, 1));
    // "[json.exception...] parse error at line 1, column 2: syntax error while ...": the position is said already.
    const std::string_view what = error.what();
    const std::size_t reason = what.find(": ", std::min(what.find("column "), what.size()));
    throw Failure(ExitCode::scene, file_name_ + ":" + line_and_column(before) + ": " +
                                       std::string(reason == std::string_view::npos ? what : what.substr(reason + 2)));
}

} // namespace

JsonLines::Place JsonLines::member(Place parent, std::string_view key) {
    return mixed(parent, std::hash<std::string_view>{}(key));
}

JsonLines::Place JsonLines::element(Place parent, std::size_t index) {
    return mixed(parent, index);
}

std::optional<std::size_t> JsonLines::find(const JsonPath &path) const {
    std::vector<Place> places{root};
    for (const JsonStep &step : path)
        places.push_back(step.in_array ? element(places.back(), step.index) : member(places.back(), step.key));
    for (; !places.empty() && (places.size() > 1 || path.empty()); places.pop_back()) {
        const auto found =
            std::find_if(lines_.rbegin(), lines_.rend(), [&](const Line &line) { return line.place == places.back(); });
        if (found != lines_.rend())
            return found->number;
    }
    return std::nullopt;
}

void parse_json_items(std::string_view text, const std::string &file_name, JsonLines &lines, JsonItemHandler &handler) {
    ItemParser(text, file_name, lines, handler).parse();
}

} // namespace cli
