// Rules and the messages about broken ones; see rules.h.
#include "lib/base/rules.h"

#include "lib/base/error.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace pt {

namespace {

template <typename Real>
std::string real_text(Real value) {
    if (std::isnan(value))
        return "nan";
    std::array<char, 64> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general);
    return std::string(text.data(), end);
}

template <typename Vector>
std::string vector_text(const Vector &value) {
    return '(' + real_text(value.x) + ", " + real_text(value.y) + ", " + real_text(value.z) + ')';
}

} // namespace

std::string number_text(double value) {
    return real_text(value);
}

std::string number_text(float value) {
    return real_text(value);
}

std::string number_text(std::uint64_t value) {
    return std::to_string(value);
}

std::string number_text(std::uint32_t value) {
    return std::to_string(value);
}

std::string number_text(const glm::dvec3 &value) {
    return vector_text(value);
}

std::string number_text(const glm::vec3 &value) {
    return vector_text(value);
}

const char *finite_rule(double value) {
    return std::isfinite(value) ? nullptr : "must be finite";
}

const char *length_rule(double value) {
    if (!std::isfinite(value))
        return "must be finite";
    return is_length(value) ? nullptr : "must be 0 or of a magnitude in [1e-18, 1e18]";
}

const char *positive_length_rule(double value) {
    if (!std::isfinite(value))
        return "must be finite";
    if (value <= 0.0)
        return "must be > 0";
    return is_positive_length(value) ? nullptr : "must lie in [1e-18, 1e18]";
}

const char *share_rule(double value) {
    if (!std::isfinite(value))
        return "must be finite";
    return is_share(value) ? nullptr : "must lie in [0, 1]";
}

void Violations::add(BrokenRule rule) {
    broken_.add(std::move(rule));
}

void Violations::throw_if_any(pt_result code) const {
    if (broken_.count() > 0)
        throw Error(code, broken_);
}

void Subject::refuse_component(const Member &member, std::int32_t component, const std::string &value,
                               const std::string &rule) const {
    violations_.add({.subject = name_,
                     .index = index_,
                     .member = member.name,
                     .component = component,
                     .with = member.with,
                     .value = value,
                     .rule = rule});
}

} // namespace pt
