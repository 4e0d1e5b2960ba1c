#include "cli/scene/json_sections.h"

#include "cli/base/exit_code.h"
#include "cli/base/text_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <unordered_set>
#include <utility>
#include <vector>

namespace cli {
namespace {

using nlohmann::json;

class SectionParser : public nlohmann::json_sax<json> {
public:
    SectionParser(std::string_view text, const std::string &file_name, JsonSectionHandler &handler) :
        text_(text),
        file_name_(file_name),
        handler_(handler) {}

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
    // An array or object that is open, and where in it the parser is.
    struct Level {
        bool is_array;
        std::size_t index;
        std::string key;
    };

    // Open levels before the value: 0 for the root, 1 for a section, 2 for an item.
    static constexpr std::size_t section_depth = 1;
    static constexpr std::size_t item_depth = 2;

    bool scalar(json value);
    bool begin(json value);
    bool end();
    json *add(json value);
    void count_element();
    template <typename Use>
    void with_place(Use use) const;

    std::string_view text_;
    const std::string &file_name_;
    JsonSectionHandler &handler_;
    std::vector<Level> levels_;
    // Keys met in the root and in the present section. Items are trees, which know their keys.
    std::array<std::unordered_set<std::string>, 2> names_;
    json item_;
    std::vector<json *> open_; // the item and, inside it, the arrays and objects not yet closed
};

// Calls use(place) with the place of the value that begins now.
template <typename Use>
void SectionParser::with_place(Use use) const {
    std::vector<JsonPlace> places(1);   // the root
    places.reserve(levels_.size() + 1); // elements point to each other and must not move
    for (const Level &level : levels_)
        places.push_back(level.is_array ? places.back().element(level.index) : places.back().member(level.key));
    use(places.back());
}

bool SectionParser::key(string_t &name) {
    levels_.back().key = name;
    const std::size_t depth = levels_.size() - 1;
    const bool fresh = depth < names_.size() ? names_[depth].insert(name).second : !open_.back()->contains(name);
    if (!fresh)
        with_place([](const JsonPlace &place) { throw JsonRefusal(place.path(), "is given twice", 2); });
    return true;
}

// Array elements have no key event: a value that begins is the next element.
void SectionParser::count_element() {
    if (!levels_.empty() && levels_.back().is_array)
        ++levels_.back().index;
}

// Puts a value into the section or item that is open. Returns where it is kept: nullptr for the root and for sections.
json *SectionParser::add(json value) {
    count_element();
    if (levels_.empty()) {
        if (!value.is_object())
            refuse({}, "must contain an object, is " + json_kind(value.type()));
        return nullptr;
    }
    if (levels_.size() == section_depth) {
        names_[section_depth].clear();
        with_place([&](const JsonPlace &place) { handler_.begin_section(place, value.type()); });
        return nullptr;
    }
    if (levels_.size() == item_depth) {
        item_ = std::move(value);
        return &item_;
    }
    json &parent = *open_.back();
    if (parent.is_array()) {
        parent.push_back(std::move(value));
        return &parent.back();
    }
    return &*parent.emplace(levels_.back().key, std::move(value)).first;
}

bool SectionParser::scalar(json value) {
    if (add(std::move(value)) == &item_)
        with_place([&](const JsonPlace &place) { handler_.item(place, item_); });
    return true;
}

bool SectionParser::begin(json value) {
    const bool is_array = value.is_array();
    if (json *added = add(std::move(value)))
        open_.push_back(added);
    // The first element increments the index to 0.
    levels_.push_back({is_array, static_cast<std::size_t>(-1), {}});
    return true;
}

bool SectionParser::end() {
    levels_.pop_back();
    if (!open_.empty()) {
        open_.pop_back();
        if (open_.empty())
            with_place([&](const JsonPlace &place) { handler_.item(place, item_); });
    }
    return true;
}

// position counts the characters read so far, the wrong one included.
bool SectionParser::parse_error(std::size_t position, const std::string &token, const json::exception &error) {
    constexpr int number_overflow = 406; // the library's documented id
    if (error.id == number_overflow) {
        count_element();
        with_place([&](const JsonPlace &place) { refuse(place, "the number " + token + " is too large"); });
    }
    const std::string_view before =
        text_.substr(0, std::min(position, text_.size() + 1) - std::min<std::size_t>(position, 1));
    // "[json.exception...] parse error at line 1, column 2: syntax error while ...": the position is said already.
    const std::string_view what = error.what();
    const std::size_t column_word = what.find("column ");
    const std::size_t reason = column_word == std::string_view::npos ? column_word : what.find(": ", column_word);
    throw Failure(ExitCode::scene, file_name_ + ":" + line_and_column(before) + ": " +
                                       std::string(reason == std::string_view::npos ? what : what.substr(reason + 2)));
}

} // namespace

void parse_json_sections(std::string_view text, const std::string &file_name, JsonSectionHandler &handler) {
    constexpr bool strict = true; // nothing may follow the root
    constexpr bool ignore_comments = true;
    SectionParser parser(text, file_name, handler);
    json::sax_parse(text.begin(), text.end(), &parser, json::input_format_t::json, strict, ignore_comments);
}

} // namespace cli
