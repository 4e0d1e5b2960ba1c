#include "cli/base/library_error.h"

#include <pt/errors.h>

namespace cli {
namespace {

std::string brackets(const std::optional<std::size_t> &index) {
    return index ? std::string("[").append(std::to_string(*index)).append("]") : "";
}

std::optional<std::size_t> known(std::int64_t index) {
    return index < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(index));
}

} // namespace

std::string field_text(const BrokenRule &rule) {
    std::string text = rule.subject + brackets(rule.index);
    if (!rule.member.empty())
        text.append(".").append(rule.member).append(brackets(rule.component));
    return text;
}

std::string rule_text(const std::string &field, const BrokenRule &rule) {
    std::string text = field;
    if (!rule.with.empty())
        text.append(" ").append(rule.with);
    return text.append(" = ").append(rule.value).append(": ").append(rule.rule);
}

std::string LibraryError::in_words(const std::function<std::string(const BrokenRule &)> &words) const {
    if (rules.empty())
        return message;
    std::string lines;
    for (const BrokenRule &rule : rules)
        lines.append(lines.empty() ? "" : "\n").append(words(rule));
    if (left_out > 0)
        lines.append("\n... and ").append(std::to_string(left_out)).append(" more");
    return lines;
}

LibraryError last_error(const pt_context *context) {
    LibraryError error{pt_last_error(context), {}, 0};
    const std::uint64_t count = pt_get_broken_rule(context, 0, nullptr);
    for (std::uint32_t i = 0; i < count; ++i) {
        pt_broken_rule rule{};
        rule.struct_size = sizeof(pt_broken_rule);
        pt_get_broken_rule(context, i, &rule);
        if (rule.subject == nullptr)
            break;
        error.rules.push_back(
            {rule.subject, known(rule.index), rule.member, known(rule.component), rule.with, rule.value, rule.rule});
    }
    error.left_out = count - error.rules.size();
    return error;
}

} // namespace cli
