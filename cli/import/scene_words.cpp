#include "cli/import/scene_words.h"

#include "cli/base/exit_code.h"
#include "cli/base/number.h"
#include "cli/data/text_number.h"

#include <algorithm>

namespace cli {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

} // namespace

void SceneWords::refuse(const std::string &what) const {
    throw Failure(ExitCode::scene, place() + ": " + what);
}

void SceneWords::pass_blanks() {
    for (;;) {
        const std::size_t size = std::min(rest_.find_first_not_of(blanks), rest_.size());
        next_line_ += static_cast<std::uint64_t>(std::count(rest_.begin(), rest_.begin() + size, '\n'));
        rest_.remove_prefix(size);
        if (!rest_.starts_with('#')) {
            return;
        }
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
    }
}

std::string_view SceneWords::peek() {
    pass_blanks();
    return rest_.substr(0, rest_.find_first_of(blanks));
}

std::optional<std::string_view> SceneWords::next() {
    const std::string_view word = peek();
    if (word.empty()) {
        return std::nullopt;
    }
    line_ = next_line_;
    rest_.remove_prefix(word.size());
    return word;
}

std::string_view SceneWords::require(std::string_view what) {
    const auto word = next();
    if (!word) {
        refuse(std::string("the file ends where ").append(what).append(" must be: it was cut short"));
    }
    return *word;
}

double SceneWords::number(std::string_view what) {
    const std::string_view word = require(what);
    double value = 0.0;
    if (const char *rule = parse_real(word, value)) {
        refuse(std::string(what).append(" = ").append(quoted_text(word)).append(": ").append(rule));
    }
    return value;
}

double SceneWords::number_from_0(std::string_view what) {
    const double value = number(what);
    if (!(value >= 0.0)) {
        refuse(std::string(what).append(": must not be negative"));
    }
    return value;
}

std::uint32_t SceneWords::whole_number(std::string_view what) {
    const std::string_view word = require(what);
    const auto value = parse_number<std::uint32_t>(word);
    if (!value || *value == 0) {
        refuse(std::string(what).append(" = ").append(quoted_text(word)).append(": must be a whole number from 1"));
    }
    return *value;
}

ForeignVector SceneWords::vector(std::string_view what) {
    ForeignVector found{};
    for (double &component : found) {
        component = number(what);
    }
    return found;
}

ForeignVector SceneWords::direction(std::string_view what) {
    const ForeignVector found = vector(what);
    if (found == ForeignVector{}) {
        refuse(std::string(what).append(": must not be 0 0 0"));
    }
    return found;
}

ForeignVector SceneWords::color(std::string_view what) {
    ForeignVector found{};
    for (double &component : found) {
        component = number_from_0(what);
    }
    return found;
}

} // namespace cli
