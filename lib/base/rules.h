#pragma once

#include "lib/base/error.h"

#include <glm/glm.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pt {

// Returns the shortest decimal that reads back as the same number.
std::string number_text(std::integral auto value) {
    return std::to_string(value);
}

std::string number_text(std::floating_point auto value) {
    if (std::isnan(value))
        return "nan";
    std::array<char, 64> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general);
    return std::string(text.data(), end);
}

template <typename Number>
std::string number_text(const glm::vec<3, Number> &value) {
    return '(' + number_text(value.x) + ", " + number_text(value.y) + ", " + number_text(value.z) + ')';
}

// Returns the rule that the value breaks, or nullptr.
using Rule = const char *(*)(double value);

inline const char *finite_rule(double value) {
    return std::isfinite(value) ? nullptr : "must be finite";
}

constexpr double min_length = 1e-18;
constexpr double max_length = 1e18;

// In float32, squares of lengths must be normal numbers (1e-36 > 2^-126), and squared distances must be finite:
// components of center + motion - position are at most 3e18, and 3 * (3e18)^2 = 2.7e37 < 2^128.
constexpr bool is_positive_length(double value) {
    return value >= min_length && value <= max_length;
}

// Tests the absolute value, because a branch on the sign would be mispredicted.
constexpr bool is_length(double value) {
    return value == 0.0 || is_positive_length(__builtin_fabs(value));
}

inline const char *length_rule(double value) {
    if (!std::isfinite(value))
        return "must be finite";
    return is_length(value) ? nullptr : "must be 0 or of a magnitude in [1e-18, 1e18]";
}

inline const char *positive_length_rule(double value) {
    if (!std::isfinite(value))
        return "must be finite";
    if (value <= 0.0)
        return "must be > 0";
    return is_positive_length(value) ? nullptr : "must lie in [1e-18, 1e18]";
}

constexpr bool is_share(double value) {
    return value >= 0.0 && value <= 1.0;
}

inline const char *share_rule(double value) {
    if (!std::isfinite(value))
        return "must be finite";
    return is_share(value) ? nullptr : "must lie in [0, 1]";
}

inline const char *not_negative_rule(double value) {
    return std::isfinite(value) && value >= 0.0 ? nullptr : "must be finite and >= 0";
}

inline const char *amount_rule(double value, double most, const char *most_rule) {
    if (!std::isfinite(value))
        return "must be finite";
    if (value < 0.0)
        return "must be >= 0";
    return value <= most ? nullptr : most_rule;
}

// float32 must hold products of two colors: 1e36 < 2^128.
inline const char *color_rule(double value) {
    return amount_rule(value, 1e18, "must be <= 1e18");
}

// A lobe exp(-n a^2 / 2) falls to 1 / e at the angle a = sqrt(2 / n). At this angle, errors d = 2^-23 of float32 unit
// vectors change the exponent by n a d = sqrt(2 n) d, which is 0.5% for n = 1e9.
inline const char *glossiness_rule(double value) {
    return amount_rule(value, 1e9, "must be <= 1e9");
}

// The field that has the value. A product has two parts: its first field and the rest of the text, {"width", "*
// height"}.
struct Member {
    Member(const char *field, const char *others = "") : name(field), with(others) {}

    const char *name;
    const char *with;
};

// The struct that is checked, named "camera" or "spheres[3]" in messages.
class Subject {
public:
    Subject(Violations &violations, const char *name) : violations_(violations), name_(name) {}
    Subject(Violations &violations, const char *name, std::size_t index) :
        violations_(violations),
        name_(name),
        index_(static_cast<std::int64_t>(index)) {}

    void refuse(const Member &member, std::string_view value, std::string_view rule) const {
        refuse_component(member, no_component, value, rule);
    }

    template <typename Value>
    void require(bool holds, const Member &member, const Value &value, std::string_view rule) const {
        if (!holds)
            refuse_value(member, no_component, value, rule);
    }

    template <typename Value>
    void check(const Member &member, Value value, Rule rule) const {
        if (const char *broken = rule(value))
            refuse_value(member, no_component, value, broken);
    }

    // Refuses an element of a column. Millions may be refused, so only the kept ones get a text.
    template <typename Value>
    void refuse_element(const Member &member, std::size_t element, const Value &value, std::string_view rule) const {
        if (violations_.only_count())
            violations_.count_one();
        else
            refuse_value(member, static_cast<std::int32_t>(element), value, rule);
    }

    template <typename Value, std::size_t N>
    void check_each(const Member &member, const Value (&values)[N], Rule rule) const {
        for (std::size_t i = 0; i < N; ++i)
            if (const char *broken = rule(values[i]))
                refuse_value(member, static_cast<std::int32_t>(i), values[i], broken);
    }

private:
    static constexpr std::int32_t no_component = -1;

    // Not inlined, because all checks use them.
    template <typename Value>
    [[gnu::noinline]] void refuse_value(const Member &member, std::int32_t component, const Value &value,
                                        std::string_view rule) const {
        refuse_component(member, component, number_text(value), rule);
    }

    [[gnu::noinline]] void refuse_component(const Member &member, std::int32_t component, std::string_view value,
                                            std::string_view rule) const {
        violations_.add({.subject = name_,
                         .index = index_,
                         .member = member.name,
                         .component = component,
                         .with = member.with,
                         .value = std::string(value),
                         .rule = std::string(rule)});
    }

    Violations &violations_;
    const char *name_;
    std::int64_t index_ = -1;
};

} // namespace pt
