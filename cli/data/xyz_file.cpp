#include "cli/data/xyz_file.h"

#include "cli/base/exit_code.h"
#include "cli/base/number.h"
#include "cli/data/column_name.h"
#include "cli/data/text_number.h"
#include "cli/data/text_rows.h"

#include <algorithm>
#include <array>

namespace cli {
namespace {

constexpr std::array<PositionNames, 2> xyz_positions{{{{"pos[0]", "pos[1]", "pos[2]"}}, {{"x", "y", "z"}}}};

struct KeyValue {
    std::string key;
    std::string value;
};

// key=value, key="a value", key={a value}; a key alone has no value.
class CommentParser {
public:
    explicit CommentParser(std::string_view text) : text_(text) {}

    // False at the end.
    bool next(KeyValue &found) {
        skip_blanks();
        if (place_ == text_.size()) {
            return false;
        }
        found = {read_word("= \t"), {}};
        if (place_ < text_.size() && text_[place_] == '=') {
            ++place_;
            found.value = read_word(" \t");
        }
        return true;
    }

private:
    void skip_blanks() { place_ = std::min(text_.find_first_not_of(" \t", place_), text_.size()); }

    // Up to one of these characters, or what is between quotes or braces.
    std::string read_word(std::string_view ends) {
        const char first = place_ < text_.size() ? text_[place_] : ' ';
        if (first == '"' || first == '\'' || first == '{') {
            ++place_;
            return read_quoted(first == '{' ? '}' : first);
        }
        const std::size_t end = std::min(text_.find_first_of(ends, place_), text_.size());
        const std::string word(text_.substr(place_, end - place_));
        place_ = end;
        return word;
    }

    std::string read_quoted(char end) {
        std::string word;
        for (; place_ < text_.size() && text_[place_] != end; ++place_) {
            if (text_[place_] == '\\' && place_ + 1 < text_.size()) {
                ++place_;
            }
            word += text_[place_];
        }
        place_ += place_ < text_.size() ? 1 : 0;
        return word;
    }

    std::string_view text_;
    std::size_t place_ = 0;
};

std::vector<std::string> split_at_colons(std::string_view text) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == ':') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

bool is_true(std::string_view word) {
    return word == "T" || word == "True" || word == "true" || word == "1";
}

} // namespace

void XyzFile::refuse(const std::string &what) const {
    throw Failure(ExitCode::scene, stream().line_place() + ": " + what);
}

std::vector<double> XyzFile::numbers_of(const std::string &key, const std::string &value, std::size_t count) const {
    std::vector<double> numbers = read_line_numbers(stream(), value);
    if (numbers.size() != count) {
        refuse(key + " = " + quoted_text(value) + ": must have " + std::to_string(count) + " numbers");
    }
    return numbers;
}

// "species:S:1:pos:R:3": name, type (text, real, whole or logical) and number of columns of each.
void XyzFile::name_columns(const std::string &properties) {
    constexpr std::uint32_t most_components = 1024;
    const std::vector<std::string> parts = split_at_colons(properties);
    columns_.clear();
    for (std::size_t i = 0; i < parts.size(); i += 3) {
        const auto count = i + 2 < parts.size() ? parse_number<std::uint32_t>(parts[i + 2]) : std::nullopt;
        if (!count || *count == 0 || *count > most_components || parts[i].empty() || parts[i + 1].size() != 1 ||
            std::string_view("SRIL").find(parts[i + 1][0]) == std::string_view::npos) {
            refuse("Properties = " + quoted_text(properties) +
                   ": must be name:type:count for each, where the type is S, R, I or L");
        }
        if (columns_.size() + *count > ParticleRows::most_columns) {
            refuse("Properties: there are more than " + std::to_string(ParticleRows::most_columns) + " columns");
        }
        for (std::uint32_t component = 0; component < *count; ++component) {
            columns_.push_back(*count == 1 ? parts[i] : component_name(parts[i], component));
        }
    }
}

void XyzFile::read_comment(std::string_view comment) {
    is_plain_ = true;
    box_.reset();
    std::optional<std::array<bool, 3>> periodic;
    std::array<double, 3> origin{};
    CommentParser parser(comment);
    for (KeyValue each; parser.next(each);) {
        if (each.key == "Properties") {
            name_columns(each.value);
            is_plain_ = false;
        } else if (each.key == "Lattice") {
            const std::vector<double> numbers = numbers_of("Lattice", each.value, 9);
            box_.emplace();
            for (std::size_t i = 0; i < 9; ++i) {
                box_->edges[i / 3][i % 3] = numbers[i];
            }
        } else if (each.key == "Origin") {
            const std::vector<double> numbers = numbers_of("Origin", each.value, 3);
            std::copy(numbers.begin(), numbers.end(), origin.begin());
        } else if (each.key == "pbc") {
            const std::vector<std::string> flags = split_at_blanks(each.value);
            if (flags.size() != 3) {
                refuse("pbc = " + quoted_text(each.value) + ": must have three flags, like T T F");
            }
            periodic = {is_true(flags[0]), is_true(flags[1]), is_true(flags[2])};
        }
    }
    if (box_) {
        box_->origin = origin;
        box_->periodic = periodic.value_or(std::array<bool, 3>{true, true, true}); // as ASE has it
    }
}

// What plain XYZ has after the four columns is called by its number, from 1.
void XyzFile::name_plain_columns() {
    columns_ = {"species", "x", "y", "z"};
    const std::string_view ahead = stream().peek(DataStream::longest);
    const std::string_view line = ahead.substr(0, ahead.find_first_of("\r\n"));
    const std::size_t count = split_at_blanks(line).size();
    for (std::size_t column = columns_.size() + 1; column <= count; ++column) {
        columns_.push_back(std::to_string(column));
    }
}

bool XyzFile::next() {
    std::string_view line;
    do {
        if (!stream().next_line(line)) {
            return false;
        }
    } while (line.find_first_not_of(" \t") == std::string_view::npos); // at the end of a file
    count_ = read_line_count(stream(), line, "the number of atoms");
    if (!stream().next_line(line)) {
        refuse("the file ends after the number of atoms: it was cut short");
    }
    read_comment(line);
    return true;
}

void XyzFile::skip() {
    skip_rows(stream(), count_);
}

void XyzFile::read(ParticleRows &rows) {
    rows.set_place([this](std::uint32_t) { return stream().line_place(); });
    if (is_plain_) {
        name_plain_columns();
    }
    rows.begin_frame(columns_, xyz_positions, box_);
    read_rows(stream(), {count_, is_plain_ ? 4 : columns_.size(), is_plain_, false}, rows);
}

} // namespace cli
