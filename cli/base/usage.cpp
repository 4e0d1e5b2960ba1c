#include "cli/base/usage.h"

#include "cli/base/suggestion.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

namespace cli {
namespace {

// Words behind a head, the lines after the first one indented.
std::string wrapped(std::string head, const std::string &text, std::size_t indentation) {
    constexpr std::size_t width = 100;
    std::size_t column = head.size();
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const std::string gap = column < indentation ? std::string(indentation - column, ' ') : " ";
        const bool is_first = column <= indentation;
        if (!is_first && column + 1 + word.size() > width) {
            head += "\n" + std::string(indentation, ' ') + word;
            column = indentation + word.size();
        } else {
            head += (column == indentation ? "" : gap) + word;
            column = std::max(column + (column == indentation ? 0 : gap.size()), indentation) + word.size();
        }
    }
    return head + "\n";
}

std::string entry(const std::string &name, const std::string &text, std::size_t column) {
    const std::string head = "  " + name;
    return head.size() + 1 < column ? wrapped(head, text, column)
                                    : head + "\n" + wrapped(std::string(column, ' '), text, column);
}

std::string related(const std::string &relation, const std::set<CLI::Option *> &options) {
    std::string names;
    for (const CLI::Option *option : options)
        names += (names.empty() ? " (" + relation + " " : ", ") + option->get_name();
    return names.empty() ? "" : names + ")";
}

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

// CLI11 says "--spp: At Most 1 required but received 2" and "--spp: 1 required N missing".
std::string reason_of_count(const std::string &text) {
    constexpr std::string_view received = " but received ";
    constexpr std::string_view required = " required ";
    constexpr std::string_view missing = " missing";
    const std::string name = text.substr(0, text.find(':'));
    if (const std::size_t at = text.rfind(received); at != std::string::npos)
        return name + ": is given " + text.substr(at + received.size()) + " times, and takes one value";
    const std::size_t at = text.find(required);
    if (at != std::string::npos && text.ends_with(missing)) {
        const std::size_t begin = at + required.size();
        return name + ": its value is missing: " + text.substr(begin, text.size() - missing.size() - begin);
    }
    return text;
}

std::string reason_of(const CLI::App &command, const CLI::ParseError &error) {
    const bool is_count = dynamic_cast<const CLI::ArgumentMismatch *>(&error) != nullptr;
    return unknown_argument(command).value_or(is_count ? reason_of_count(error.what()) : error.what());
}

} // namespace

HelpFormatter::HelpFormatter() {
    column_width(30);
    label("Positionals", "Arguments");
    label("SUBCOMMAND", "COMMAND");
}

// CLI11 has two empty lines between groups.
std::string HelpFormatter::make_help(const CLI::App *command, std::string name, CLI::AppFormatMode mode) const {
    return CLI::detail::find_and_replace(CLI::Formatter::make_help(command, std::move(name), mode), "\n\n\n", "\n\n");
}

std::string HelpFormatter::make_option(const CLI::Option *option, bool is_positional) const {
    const std::string value = is_positional ? "" : make_option_opts(option);
    const std::string others = related("needs", option->get_needs()) + related("not with", option->get_excludes());
    return entry(make_option_name(option, is_positional) + value, option->get_description() + others, column_width_);
}

std::string HelpFormatter::make_option_opts(const CLI::Option *option) const {
    return option->get_items_expected_max() == 0 ? "" : " " + option->get_type_name();
}

std::string HelpFormatter::make_subcommand(const CLI::App *command) const {
    return entry(command->get_name(), command->get_description(), column_width_);
}

std::string HelpFormatter::make_footer(const CLI::App *command) const {
    std::string text;
    std::string paragraph;
    const auto end_paragraph = [&] {
        text += paragraph.empty() ? "" : wrapped("", paragraph, 0);
        paragraph.clear();
    };
    std::istringstream lines(command->get_footer());
    for (std::string line; std::getline(lines, line);) {
        const bool is_row = line.starts_with("  ");
        if (line.empty() || is_row)
            end_paragraph();
        if (line.empty()) {
            text += "\n";
        } else if (is_row) {
            const std::size_t key_end = line.find(' ', 2);
            const std::size_t column = line.find_first_not_of(' ', key_end);
            text += wrapped(line.substr(0, key_end), line.substr(column), column);
        } else {
            paragraph += line + " ";
        }
    }
    end_paragraph();
    return text;
}

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

std::string usage_reason(const CLI::App &program, const CLI::ParseError &error) {
    const std::vector<CLI::App *> parsed = program.get_subcommands();
    if (parsed.empty())
        return reason_of(program, error) + " (see pt --help)";
    const CLI::App &command = *parsed.front();
    const std::string see = " (see pt " + command.get_name() + " --help)";
    const std::vector<std::string> before = program.remaining();
    if (!before.empty())
        return before.front() + ": stands before the command; its options stand after it" + see;
    return reason_of(command, error) + see;
}

} // namespace cli
