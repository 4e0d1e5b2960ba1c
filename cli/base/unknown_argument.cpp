#include "cli/base/unknown_argument.h"

#include "cli/base/suggestion.h"

#include <CLI/CLI.hpp>

#include <string_view>
#include <vector>

namespace cli {
namespace {

// "--exposure", as users write them.
std::vector<std::string> option_names(const CLI::App &command) {
    std::vector<std::string> names;
    for (const CLI::Option *option : command.get_options())
        for (const std::string &name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

std::vector<std::string> subcommand_names(const CLI::App &command) {
    std::vector<std::string> names;
    for (const CLI::App *subcommand : command.get_subcommands([](const CLI::App *) { return true; }))
        names.push_back(subcommand->get_name());
    return names;
}

std::string unknown(std::string_view kind, std::string_view name, const std::vector<std::string> &known) {
    return unknown_name(kind, name, std::vector<std::string_view>(known.begin(), known.end()));
}

} // namespace

std::optional<std::string> unknown_argument(const CLI::App &command) {
    const std::vector<std::string> left_over = command.remaining();
    if (left_over.empty())
        return std::nullopt;
    const std::string &first = left_over.front();
    if (first.starts_with('-'))
        return unknown("option", first.substr(0, first.find('=')), option_names(command));
    const std::vector<std::string> subcommands = subcommand_names(command);
    return subcommands.empty() ? "unexpected argument \"" + first + "\"" : unknown("command", first, subcommands);
}

} // namespace cli
