#include "lib/base/error.h"

#include "lib/platform/printable.h"

#include <utility>

namespace pt {

namespace {

std::string brackets(std::int64_t index) {
    return index < 0 ? std::string() : '[' + std::to_string(index) + ']';
}

Violations only(BrokenRule rule) {
    Violations rules;
    rules.add(std::move(rule));
    return rules;
}

constexpr std::pair<pt_result, const char *> names[] = {
    {PT_OK, "PT_OK"},
    {PT_CANCELLED, "PT_CANCELLED"},
    {PT_TARGET_REACHED, "PT_TARGET_REACHED"},
    {PT_PENDING, "PT_PENDING"},
    {PT_LIMIT_REACHED, "PT_LIMIT_REACHED"},
    {PT_ERROR_INVALID_ARGUMENT, "PT_ERROR_INVALID_ARGUMENT"},
    {PT_ERROR_INVALID_SCENE, "PT_ERROR_INVALID_SCENE"},
    {PT_ERROR_INVALID_STATE, "PT_ERROR_INVALID_STATE"},
    {PT_ERROR_UNSUPPORTED, "PT_ERROR_UNSUPPORTED"},
    {PT_ERROR_NO_DEVICE, "PT_ERROR_NO_DEVICE"},
    {PT_ERROR_OUT_OF_HOST_MEMORY, "PT_ERROR_OUT_OF_HOST_MEMORY"},
    {PT_ERROR_OUT_OF_DEVICE_MEMORY, "PT_ERROR_OUT_OF_DEVICE_MEMORY"},
    {PT_ERROR_DEVICE_LOST, "PT_ERROR_DEVICE_LOST"},
    {PT_ERROR_SHADER, "PT_ERROR_SHADER"},
    {PT_ERROR_INTERNAL, "PT_ERROR_INTERNAL"},
    {PT_ERROR_INCOMPATIBLE, "PT_ERROR_INCOMPATIBLE"},
    {PT_ERROR_FILE, "PT_ERROR_FILE"},
};

} // namespace

std::string BrokenRule::field() const {
    return subject + brackets(index) + (member.empty() ? "" : '.' + member + brackets(component));
}

std::string BrokenRule::text(const std::string &name_of_field) const {
    return name_of_field + (with.empty() ? "" : ' ' + with) + " = " + value + ": " + rule;
}

void Violations::add(BrokenRule rule) {
    if (!only_count()) {
        rule.value = platform::printable(rule.value);
        first_.push_back(std::move(rule));
    }
    count_one();
}

std::string Violations::text() const {
    std::string lines;
    for (const BrokenRule &rule : first_)
        lines.append(lines.empty() ? "" : "\n").append(rule.text());
    if (count_ > first_.size())
        lines.append("\n... and ").append(std::to_string(count_ - first_.size())).append(" more");
    return lines;
}

void Violations::throw_if_any(pt_result code) const {
    if (count_ > 0)
        throw Error(code, *this);
}

Error::Error(pt_result code, const std::string &message) : std::runtime_error(message), code_(code) {}

Error::Error(pt_result code, Violations rules) :
    std::runtime_error(rules.text()),
    code_(code),
    broken_rules_(std::make_shared<const Violations>(std::move(rules))) {}

Error::Error(pt_result code, BrokenRule rule) : Error(code, only(std::move(rule))) {}

void refuse_argument(std::string_view subject, std::string_view member, std::string_view value, std::string_view rule,
                     pt_result code) {
    throw Error(code, BrokenRule{.subject = std::string(subject),
                                 .member = std::string(member),
                                 .value = std::string(value),
                                 .rule = std::string(rule)});
}

const char *result_name(pt_result result) noexcept {
    for (const auto &[known, name] : names)
        if (known == result)
            return name;
    return "unknown result";
}

} // namespace pt
