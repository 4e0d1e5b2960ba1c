// How broken rules are put into words, for all messages; see broken_rule.h.
#include "lib/base/broken_rule.h"

#include <utility>

namespace pt {

namespace {

std::string brackets(std::int64_t index) {
    return index < 0 ? std::string() : '[' + std::to_string(index) + ']';
}

} // namespace

std::string BrokenRule::text() const {
    std::string field = subject + brackets(index);
    if (!member.empty())
        field += '.' + member + brackets(component);
    if (!with.empty())
        field += ' ' + with;
    return field + " = " + value + ": " + rule;
}

void BrokenRules::add(BrokenRule rule) {
    if (!is_full())
        first_.push_back(std::move(rule));
    count_one();
}

std::string BrokenRules::text() const {
    std::string lines;
    for (const BrokenRule &rule : first_)
        lines.append(lines.empty() ? "" : "\n").append(rule.text());
    if (count_ > first_.size())
        lines.append("\n... and ").append(std::to_string(count_ - first_.size())).append(" more");
    return lines;
}

} // namespace pt
