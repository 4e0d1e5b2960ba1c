#include "cli/help/command_text.h"

#include "cli/help/value_words.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <set>

namespace cli {
namespace {

std::string listed(const std::set<CLI::Option *> &options, const std::string &relation) {
    std::string names;
    for (const CLI::Option *option : options) {
        names += (names.empty() ? "" : ", ") + option->get_name();
    }
    return names.empty() ? "" : " (" + relation + " " + names + ")";
}

bool repeats(const CLI::Option &option) {
    return option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
}

OptionText option_text(const CLI::Option &option) {
    OptionText text{};
    for (const std::string &name : option.get_snames()) {
        text.names.push_back("-" + name);
    }
    for (const std::string &name : option.get_lnames()) {
        text.names.push_back("--" + name);
    }
    const bool takes_value = option.get_items_expected_max() > 0;
    text.value = takes_value ? option.get_type_name() : "";
    text.value_may_lack = takes_value && option.get_items_expected_min() == 0;
    text.may_repeat = repeats(option);
    text.description =
        option.get_description() + listed(option.get_needs(), "needs") + listed(option.get_excludes(), "not with");
    return text;
}

ArgumentText argument_text(const CLI::Option &argument) {
    std::string words;
    for (const std::string &word : value_words(argument.get_type_name()).words) {
        words += (words.empty() ? ": " : ", ") + word;
    }
    return {argument.get_name(true), argument.get_type_name(), !argument.get_required(),
            argument.get_items_expected_max() > 1, argument.get_description() + words};
}

void add_to_group(std::vector<OptionGroup> &groups, const CLI::Option &option) {
    const auto has_its_name = [&](const OptionGroup &group) { return group.name == option.get_group(); };
    auto group = std::find_if(groups.begin(), groups.end(), has_its_name);
    if (group == groups.end()) {
        groups.push_back({option.get_group(), {}});
        group = std::prev(groups.end());
    }
    group->options.push_back(option_text(option));
}

std::vector<OptionGroup> option_groups(const CLI::App &command) {
    std::vector<OptionGroup> groups;
    const auto is_shown = [](const CLI::Option *option) {
        return option->nonpositional() && !option->get_group().empty();
    };
    for (const CLI::Option *option : command.get_options(is_shown)) {
        if (option != command.get_help_ptr()) {
            add_to_group(groups, *option);
        }
    }
    if (groups.empty()) {
        groups.push_back({command.get_help_ptr()->get_group(), {}});
    }
    groups.back().options.push_back(option_text(*command.get_help_ptr()));
    return groups;
}

} // namespace

CommandText command_text(const CLI::App &command) {
    CommandText text{};
    text.name = (command.get_parent() == nullptr ? "" : command.get_parent()->get_name() + " ") + command.get_name();
    text.description = command.get_description();
    for (const CLI::Option *argument :
         command.get_options([](const auto *option) { return option->get_positional(); })) {
        text.arguments.push_back(argument_text(*argument));
    }
    text.groups = option_groups(command);
    text.notes = command.get_footer();
    for (const CLI::App *subcommand : command.get_subcommands([](const CLI::App *) { return true; })) {
        text.commands.push_back(command_text(*subcommand));
    }
    return text;
}

std::string usage_text(const CommandText &command) {
    std::string usage = command.name + " [OPTIONS]";
    for (const ArgumentText &argument : command.arguments) {
        const std::string name = argument.name + (argument.may_repeat ? "..." : "");
        usage += argument.may_lack ? " [" + name + "]" : " " + name;
    }
    return usage + (command.commands.empty() ? "" : " COMMAND");
}

std::string option_with_value(const OptionText &option, const std::string &name) {
    if (option.value.empty()) {
        return name;
    }
    return option.value_may_lack ? name + " [" + option.value + "]" : name + " " + option.value;
}

} // namespace cli
