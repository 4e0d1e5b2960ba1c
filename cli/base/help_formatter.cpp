#include "cli/base/help_formatter.h"

#include <algorithm>
#include <sstream>

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

} // namespace cli
