#include "cli/help/help_text.h"

#include "cli/help/paragraphs.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace cli {
namespace {

constexpr std::size_t help_width = 100;
constexpr std::size_t description_column = 30;

// A name and its description beside it, or below, where the name is too long.
std::string help_entry(const std::string &name, const std::string &description, std::size_t column) {
    const std::string head = "  " + name;
    const std::string gap =
        head.size() < column - 1 ? std::string(column - head.size(), ' ') : "\n" + std::string(column, ' ');
    return head + gap + wrapped(description, column, help_width, column) + "\n";
}

std::string names_of(const OptionText &option) {
    std::string names;
    for (const std::string &name : option.names) {
        names += (names.empty() ? "" : ",") + name;
    }
    return option_with_value(option, names);
}

std::string table_text(const Paragraph &table) {
    std::string text = table.title + ":\n";
    std::size_t widest = 0;
    for (const TableRow &row : table.rows) {
        widest = std::max(widest, row.key.size());
    }
    for (const TableRow &row : table.rows) {
        text += help_entry(row.key, row.text, widest + 4);
    }
    return text;
}

} // namespace

std::string help_text(const CommandText &command) {
    std::string text = command.description + "\nUsage: " + usage_text(command) + "\n";
    if (!command.arguments.empty()) {
        text += "\nArguments:\n";
    }
    for (const ArgumentText &argument : command.arguments) {
        text +=
            help_entry(argument.name + (argument.may_repeat ? "..." : ""), argument.description, description_column);
    }
    if (!command.commands.empty()) {
        text += "\nCommands:\n";
    }
    for (const CommandText &each : command.commands) {
        text += help_entry(each.name.substr(command.name.size() + 1), each.description, description_column);
    }
    for (const OptionGroup &group : command.groups) {
        text += "\n" + group.name + ":\n";
        for (const OptionText &option : group.options) {
            text += help_entry(names_of(option), option.description, description_column);
        }
    }
    for (const Paragraph &paragraph : paragraphs(command.notes)) {
        text += "\n" + (paragraph.rows.empty() ? "" : table_text(paragraph));
        text += paragraph.text.empty() ? "" : wrapped(paragraph.text, 0, help_width, 0) + "\n";
    }
    return text;
}

namespace {

class HelpFormatter : public CLI::FormatterBase {
public:
    std::string make_help(const CLI::App *command, std::string /*name*/, CLI::AppFormatMode /*mode*/) const override {
        return help_text(command_text(*command));
    }
};

} // namespace

std::shared_ptr<CLI::FormatterBase> help_formatter() {
    return std::make_shared<HelpFormatter>();
}

} // namespace cli
