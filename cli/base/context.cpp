#include "cli/base/context.h"

#include <pt/errors.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace cli {
namespace {

struct OptionName {
    std::string_view subject;
    std::string_view member;
    const char *option;
};

constexpr std::array<OptionName, 9> option_names{{
    {"render", "width", "--size: width"},
    {"render", "height", "--size: height"},
    {"render", "max_path_length", "--max-path-length"},
    {"accumulate", "sample_count", "--spp"},
    {"accumulate", "sampling", "--sampling"},
    {"create", "device", "--device"},
    {"create", "shader_dir", "--shader-dir"},
    {"create", "submit_milliseconds", "--submit-ms"},
    {"denoise", "library", "--denoise"},
}};

} // namespace

const char *find_option(const BrokenRule &rule) {
    const auto found = std::ranges::find_if(option_names, [&rule](const OptionName &name) {
        return rule.subject == name.subject && rule.member == name.member;
    });
    return found == option_names.end() ? nullptr : found->option;
}

std::string in_words_of_options(const BrokenRule &rule) {
    const char *option = find_option(rule);
    return rule.text(option != nullptr ? option : rule.field());
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
    return BrokenRule{rule.subject, rule.index, rule.member, rule.component, rule.with, rule.value, rule.rule};
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
