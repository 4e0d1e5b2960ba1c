// The pattern of values that fits measurements best: the right one, or a usual mistake's.
#pragma once

#include "cli/course/measured.h"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

struct Range {
    double least;
    double most;
};

constexpr Range exactly(double value) {
    return {value, value};
}

// Allows for the error of quadrature.
constexpr Range nearly(double value) {
    return {0.997 * value, 1.003 * value};
}

inline constexpr Range any_value{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

struct Pattern {
    std::string name; // empty for a right step
    std::string hint;
    std::vector<Range> values; // of all stages

    bool is_right() const { return name.empty(); }
};

struct CourseVerdict {
    std::vector<Measured> measured;
    std::vector<Range> expected; // values of the nearest right pattern
    std::optional<Pattern> fitting;
    std::string other_light; // of a failed test for equal light
    double rejected = 0.0;   // samples that were NaN, infinite, negative or too bright

    bool is_right() const { return fitting && fitting->is_right() && other_light.empty(); }
};

// Returns the largest deviation from the pattern in units of the measurements' bounds.
double misfit(std::span<const Measured> measured, const Pattern &pattern);

// `patterns` must include a right one. Mistakes with the right values so far do not fit.
CourseVerdict judge(std::vector<Measured> measured, std::span<const Pattern> patterns);

} // namespace cli
