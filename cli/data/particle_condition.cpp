#include "cli/data/particle_condition.h"

#include "cli/base/number.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

namespace cli {
namespace {

struct Operator {
    std::string_view text;
    Comparison comparison;
};

// Those of two characters first, as they begin with those of one.
constexpr std::array<Operator, 6> operators{{{"<=", Comparison::less_or_equal},
                                             {">=", Comparison::greater_or_equal},
                                             {"==", Comparison::equal},
                                             {"!=", Comparison::not_equal},
                                             {"<", Comparison::less},
                                             {">", Comparison::greater}}};

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

} // namespace

ParticleCondition parse_condition(const std::string &text) {
    const auto refuse = [&text]() -> std::invalid_argument {
        return std::invalid_argument(
            "\"" + text +
            "\": must be a column, one of <, <=, >, >=, == and != and a number, like \"z < 5\", "
            "or a word after == and !=, like \"element == O\"");
    };
    const std::size_t place = text.find_first_of("<>=!");
    if (place == std::string::npos) {
        throw refuse();
    }
    const std::string_view rest = std::string_view(text).substr(place);
    const auto *found = std::find_if(operators.begin(), operators.end(),
                                     [rest](const Operator &each) { return rest.starts_with(each.text); });
    if (found == operators.end()) {
        throw refuse();
    }
    const std::string_view column = trimmed(std::string_view(text).substr(0, place));
    const std::string_view limit = trimmed(rest.substr(found->text.size()));
    ParticleCondition condition{std::string(column), found->comparison, 0.0, {}, text};
    const bool takes_word = condition.comparison == Comparison::equal || condition.comparison == Comparison::not_equal;
    if (const auto number = parse_number<double>(limit)) {
        condition.number = *number;
    } else if (takes_word && limit.find_first_of("<>=! \t") == std::string_view::npos) {
        condition.word = limit;
    } else {
        throw refuse();
    }
    if (column.empty() || limit.empty()) {
        throw refuse();
    }
    return condition;
}

} // namespace cli
