// Rules for the caller's numbers, and the list of those that were broken. Used by scene, camera, render_settings,
// image and api.cpp.
#pragma once

#include <pt/pt.h>

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pt {

// The shortest decimal that reads back as the same number; "nan" without a sign.
std::string number_text(double value);
std::string number_text(float value);
std::string number_text(std::uint64_t value);
std::string number_text(std::uint32_t value);
// "(x, y, z)"
std::string number_text(const glm::dvec3 &value);

// A rule says what a value must be, or nullptr if it is.
using Rule = const char *(*)(double value);

const char *finite_rule(double value);

// Lengths are 0 or have a magnitude in [1e-18, 1e18], so that in float32 their squares are normal numbers and sums of
// squares are finite: 1e-36 > 2^-126 = 1.18e-38, and 3 * (3e18)^2 = 2.7e37 < 2^128 = 3.4e38 is the largest squared
// distance of a sphere from the camera, each of whose components adds up three lengths (centre, motion, position).
const char *length_rule(double value);
const char *positive_length_rule(double value);

// The broken rules of what one call was given, as one message with a line for each of the first few.
class Violations {
public:
    static constexpr std::size_t max_lines = 8;

    void add(const std::string &field, const std::string &value, std::string_view rule);

    // Throws Error if a rule was broken.
    void throw_if_any(pt_result code) const;

private:
    std::size_t count_ = 0;
    std::string lines_;
};

// A struct whose fields are checked: "camera", or "spheres[3]".
class Subject {
public:
    Subject(Violations &violations, std::string_view name, std::optional<std::size_t> index = std::nullopt) :
        violations_(violations),
        name_(name),
        index_(index) {}

    template <typename Value>
    void require(bool holds, std::string_view member, const Value &value, std::string_view rule) const {
        if (!holds)
            violations_.add(field(member), number_text(value), rule);
    }

    template <typename Value>
    void check(std::string_view member, Value value, Rule rule) const {
        if (const char *broken = rule(value))
            violations_.add(field(member), number_text(value), broken);
    }

    // Every component of an array, which is named in the message.
    template <typename Value, std::size_t N>
    void check_each(std::string_view member, const Value (&values)[N], Rule rule) const {
        for (std::size_t i = 0; i < N; ++i)
            if (const char *broken = rule(values[i]))
                violations_.add(field(member) + '[' + std::to_string(i) + ']', number_text(values[i]), broken);
    }

private:
    std::string field(std::string_view member) const;

    Violations &violations_;
    std::string_view name_;
    std::optional<std::size_t> index_;
};

} // namespace pt
