#include "cli/base/context.h"

#include "lib/platform/printable.h"

#include <pt/errors.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace cli {
namespace {

struct OptionName {
    std::string_view subject; // subject and member as in pt_broken_rule
    std::string_view member;
    const char *option;
};

constexpr std::array<OptionName, 10> option_names{{
    {"render", "width", "--size: width"},
    {"render", "height", "--size: height"},
    {"render", "max_path_length", "--max-path-length"},
    {"accumulate", "sample_count", "--spp"},
    {"accumulate", "target_error", "--error"},
    {"accumulate", "sampling", "--sampling"},
    {"create", "device", "--device"},
    {"create", "shader_dir", "--shader-dir"},
    {"create", "submit_milliseconds", "--submit-ms"},
    {"denoise", "library", "--denoise"},
}};

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

const char *find_option(const BrokenRule &rule) {
    const auto found = std::ranges::find_if(option_names, [&rule](const OptionName &name) {
        return rule.subject == name.subject && rule.member == name.member;
    });
    return found == option_names.end() ? nullptr : found->option;
}

std::string in_words_of_options(const BrokenRule &rule) {
    const char *option = find_option(rule);
    return rule_text(option != nullptr ? option : field_text(rule), rule);
}

std::string rule_text(const std::string &field, const BrokenRule &rule) {
    std::string text = field;
    if (!rule.with.empty())
        text.append(" ").append(rule.with);
    return text.append(" = ").append(platform::printable(rule.value)).append(": ").append(rule.rule);
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

std::optional<BrokenRule> broken_rule(const pt_broken_rule &rule) {
    if (rule.subject == nullptr)
        return std::nullopt;
    return BrokenRule{rule.subject, known(rule.index), rule.member, known(rule.component),
                      rule.with,    rule.value,        rule.rule};
}

LibraryError last_error(const pt_context *context) {
    LibraryError error{pt_last_error(context), {}, 0};
    const std::uint64_t count = pt_get_broken_rule(context, 0, nullptr);
    for (std::uint32_t i = 0; i < count; ++i) {
        auto kept = sized<pt_broken_rule>();
        pt_get_broken_rule(context, i, &kept);
        const auto rule = broken_rule(kept);
        if (!rule)
            break;
        error.rules.push_back(*rule);
    }
    error.left_out = count - error.rules.size();
    return error;
}

} // namespace cli
