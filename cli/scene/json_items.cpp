#include "cli/scene/json_items.h"

#include "cli/base/exit_code.h"
#include "cli/base/text_file.h"
#include "cli/base/value_rule.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <unordered_set>

namespace cli {
namespace {

using nlohmann::json;

// Tells how far the parser has come.
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

JsonLines::Place mixed(JsonLines::Place parent, std::uint64_t step) {
    const std::uint64_t sum = (parent + step + 1) * 0x9e3779b97f4a7c15; // splitmix64 (Steele, Lea, Flood 2014)
    return sum ^ (sum >> 31);
}

class ItemParser {
public:
    // reached: how far the text is read.
    ItemParser(JsonLines &lines, JsonItemHandler &handler, const char *const &reached) :
        lines_(lines),
        handler_(handler),
        reached_(reached),
        counted_(reached) {}

    // The parser's callback: false if the value is not to be kept.
    bool take(json::parse_event_t event, const json &parsed) {
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

    // A number that is too large for double is a value that has a place.
    [[noreturn]] void refuse_overflow(const std::string &what) {
        enter_value(json::value_t::number_float);
        const std::size_t quote = what.find('\'');
        throw JsonRefusal(path(),
                          "the number " + what.substr(quote + 1, what.rfind('\'') - quote - 1) + " is too large");
    }

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

    JsonPath path() const {
        JsonPath path;
        for (const Level &level : levels_)
            path.push_back(level.step);
        return path;
    }

    // The parser reads one character beyond a number, which may end the line: the last one that was read does not
    // count.
    void enter(JsonLines::Place hash) {
        const char *const end = std::max(counted_, reached_ - 1);
        line_ += static_cast<std::size_t>(std::count(counted_, end, '\n'));
        counted_ = end;
        value_ = {hash, line_};
        if (levels_.size() <= section_depth || value_.line != levels_.back().place.line)
            lines_.add(hash, value_.line);
    }

    void enter_member(const std::string &name) {
        Level &level = levels_.back();
        level.step.key = name;
        enter(JsonLines::member(level.place.hash, name));
        if (!is_new(value_.hash))
            throw JsonRefusal(path(), "is given twice");
    }

    // Items have few members, but may be millions; sections may have many.
    bool is_new(JsonLines::Place member) {
        if (levels_.size() <= element_depth)
            return members_.insert(member).second;
        const bool is_known = std::ranges::find(members_of_item_, member) != members_of_item_.end();
        members_of_item_.push_back(member);
        return !is_known;
    }

    // A member has a line since its key was read. Array elements have no such event: a value that begins is the next.
    void enter_value(json::value_t kind) {
        if (levels_.empty()) {
            enter(JsonLines::root);
            if (kind != json::value_t::object)
                refuse({}, "must contain an object, is " + json_kind(kind));
        } else if (JsonStep &step = levels_.back().step; step.in_array) {
            ++step.index;
            enter(JsonLines::element(levels_.back().place.hash, step.index));
        }
        if (levels_.size() == section_depth) {
            const JsonPlace root;
            handler_.begin_section(root.member(levels_[0].step.key), kind);
        }
    }

    void begin(bool is_array) {
        enter_value(is_array ? json::value_t::array : json::value_t::object);
        levels_.push_back(
            {value_, {{}, is_array ? static_cast<std::size_t>(-1) : 0, is_array}}); // the first makes it 0
    }

    // Items are handed out, and not kept.
    bool hand_out(const json &value) {
        if (levels_.size() != element_depth)
            return true;
        const JsonPlace root;
        const JsonPlace section = root.member(levels_[0].step.key);
        const JsonStep &step = levels_[1].step;
        members_of_item_.clear();
        handler_.item(step.in_array ? section.element(step.index) : section.member(step.key), value);
        return false;
    }

    JsonLines &lines_;
    JsonItemHandler &handler_;
    const char *const &reached_;
    const char *counted_; // up to where lines are
    std::size_t line_ = 1;
    std::vector<Level> levels_;
    Place value_;                                  // that began last
    std::unordered_set<JsonLines::Place> members_; // of the root and of sections
    std::vector<JsonLines::Place> members_of_item_;
};

// "[json.exception...] parse error at line 1, column 2: syntax error while ...", with the place in the file's words.
// error.byte counts the characters read so far, the wrong one included.
Failure failure_of(const json::parse_error &error, std::string_view text, const std::string &file_name) {
    const std::string_view before =
        text.substr(0, std::min(error.byte, text.size() + 1) - std::min<std::size_t>(error.byte, 1));
    const std::string_view what = error.what();
    const std::size_t reason = what.find(": ", std::min(what.find("column "), what.size()));
    return {ExitCode::scene, file_name + ":" + line_and_column(before) + ": " +
                                 std::string(reason == std::string_view::npos ? what : what.substr(reason + 2))};
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
    if (text.empty()) // for which versions of nlohmann-json have different words
        throw Failure(ExitCode::scene, file_name + ":1:1: syntax error: the file is empty");
    constexpr int number_overflow = 406; // the library's documented id
    constexpr bool throws = true;
    constexpr bool ignore_comments = true;
    const char *reached = text.data();
    ItemParser parser(lines, handler, reached);
    const auto take = [&](int, json::parse_event_t event, const json &parsed) { return parser.take(event, parsed); };
    try {
        [[maybe_unused]] const json empty_sections =
            json::parse(TellingIterator(text.data(), reached), TellingIterator(text.data() + text.size(), reached),
                        take, throws, ignore_comments);
    } catch (const json::parse_error &error) {
        throw failure_of(error, text, file_name);
    } catch (const json::out_of_range &error) {
        if (error.id != number_overflow)
            throw;
        parser.refuse_overflow(error.what());
    }
}

} // namespace cli
