// Conditions by which particles are chosen: "z < 5", "type == 2", "species != H".
#pragma once

#include <string>

namespace cli {

enum class Comparison { less, less_or_equal, greater, greater_or_equal, equal, not_equal };

struct ParticleCondition {
    std::string column;
    Comparison comparison;
    double number;
    std::string word; // in place of the number if it is not empty; with == and != alone
    std::string text; // as it was given
};

// Throws std::invalid_argument, which says what a condition is.
ParticleCondition parse_condition(const std::string &text);

inline bool holds(Comparison comparison, double value, double limit) {
    switch (comparison) {
    case Comparison::less:
        return value < limit;
    case Comparison::less_or_equal:
        return value <= limit;
    case Comparison::greater:
        return value > limit;
    case Comparison::greater_or_equal:
        return value >= limit;
    case Comparison::equal:
        return value == limit;
    default:
        return value != limit;
    }
}

} // namespace cli
