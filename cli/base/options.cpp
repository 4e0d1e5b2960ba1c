#include "cli/base/options.h"

#include "cli/base/exit_code.h"
#include "cli/base/number.h"
#include "cli/base/text.h"
#include "lib/scene_file/names.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace cli {
namespace {

std::string type_name(const ValueRule &rule) {
    switch (rule.form) {
    case ValueRule::Form::name:
        return listed(rule.names, "|");
    case ValueRule::Form::whole_number:
        return "N";
    case ValueRule::Form::number_or_auto:
        return "X|auto";
    case ValueRule::Form::numbers:
        return "X,X,X";
    default:
        return "X";
    }
}

std::string wrapped(const std::string &text, std::size_t first_column) {
    constexpr std::size_t width = 100;
    std::string lines;
    std::size_t column = first_column;
    std::istringstream words(text);
    for (std::string word; words >> word; column += word.size()) {
        const bool fits = column + 1 + word.size() <= width;
        if (!lines.empty()) {
            lines += fits ? " " : "\n" + std::string(first_column, ' ');
            column = fits ? column + 1 : first_column;
        }
        lines += word;
    }
    return lines + "\n";
}

std::string entry(const std::string &name, const std::string &text, std::size_t column) {
    const std::string head = "  " + name;
    const bool fits = head.size() + 1 < column;
    return head + (fits ? "" : "\n") + std::string(fits ? column - head.size() : column, ' ') + wrapped(text, column);
}

std::string related(const std::string &relation, const std::set<CLI::Option *> &options) {
    std::string names;
    for (const CLI::Option *option : options)
        names += (names.empty() ? " (" + relation + " " : ", ") + option->get_name();
    return names.empty() ? "" : names + ")";
}

std::vector<std::string> option_names(const CLI::App &command) {
    std::vector<std::string> names;
    for (const CLI::Option *option : command.get_options())
        for (const std::string &name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

std::string unknown(std::string_view kind, std::string_view name, const std::vector<std::string> &known) {
    return pt::unknown_name(kind, name, std::vector<std::string_view>(known.begin(), known.end()));
}

std::string_view command_that_reads(std::string_view name) {
    return name.ends_with(".json")     ? "render"
           : name.ends_with(".ptfilm") ? "merge"
           : name.ends_with(".exr")    ? "tonemap"
                                       : "";
}

std::optional<std::string> unknown_argument(const CLI::App &command) {
    const std::vector<std::string> left_over = command.remaining();
    if (left_over.empty())
        return std::nullopt;
    const std::string &first = left_over.front();
    if (first.starts_with('-'))
        return unknown("option", first.substr(0, first.find('=')), option_names(command));
    const std::vector<std::string> subcommands = command_names(command);
    if (subcommands.empty())
        return "unexpected argument \"" + first + "\"";
    const std::string_view reader = command_that_reads(first);
    return reader.empty() ? unknown("command", first, subcommands)
                          : concat("unknown command \"", first, "\", did you mean \"pt ", reader, " ", first, "\"?");
}

std::string mismatch_text(const CLI::App &command, const std::string &message) {
    const std::string name = message.substr(0, message.find(':'));
    const CLI::Option *option = command.get_option_no_throw(name);
    if (option == nullptr)
        return message;
    const bool is_too_often = option->count() > static_cast<std::size_t>(option->get_items_expected_max());
    return is_too_often ? concat(name, ": is given ", option->count(), " times, must be given once")
                        : concat(name, ": its ", option->get_type_name(), " is missing");
}

std::string reason_of(const CLI::App &command, const CLI::ParseError &error) {
    if (const auto unknown = unknown_argument(command))
        return *unknown;
    const bool is_mismatch = dynamic_cast<const CLI::ArgumentMismatch *>(&error) != nullptr;
    return is_mismatch ? mismatch_text(command, error.what()) : error.what();
}

class HelpFormatter : public CLI::Formatter {
public:
    HelpFormatter() {
        column_width(30);
        label("Positionals", "Arguments");
        label("SUBCOMMAND", "COMMAND");
    }

    // CLI11 writes two empty lines between groups.
    std::string make_help(const CLI::App *command, std::string name, CLI::AppFormatMode mode) const override {
        return CLI::detail::find_and_replace(CLI::Formatter::make_help(command, std::move(name), mode), "\n\n\n",
                                             "\n\n");
    }

    std::string make_option(const CLI::Option *option, bool is_positional) const override {
        const std::string value = is_positional ? "" : make_option_opts(option);
        const std::string others = related("needs", option->get_needs()) + related("not with", option->get_excludes());
        std::string name = make_option_name(option, is_positional);
        name = CLI::detail::find_and_replace(CLI::detail::find_and_replace(std::move(name), "{", "[="), "}", "]");
        return entry(name + value, option->get_description() + others, column_width_);
    }

    std::string make_option_opts(const CLI::Option *option) const override {
        return option->get_items_expected_max() == 0 ? "" : " " + option->get_type_name();
    }

    std::string make_subcommand(const CLI::App *command) const override {
        return entry(command->get_name(), command->get_description(), column_width_);
    }
};

} // namespace

CLI::App &add_command(CLI::App &program, Run &chosen, const std::string &name, const std::string &description,
                      const std::string &notes, Run run) {
    CLI::App &command = *program.add_subcommand(name, description);
    command.group("Commands");
    command.footer(notes + (notes.empty() ? "" : "\n") + exit_code_help);
    command.set_help_flag("-h,--help", "Print this help and exit");
    command.final_callback([&chosen, run = std::move(run)] { chosen = run; });
    return command;
}

void refuse_option(const std::string &option, const std::string &rule, const std::string &text) {
    throw CLI::ValidationError(option, rule + ", is \"" + text + "\"");
}

// Converts "1,2,3" to an array. Other texts remain strings.
nlohmann::json numbers_of(const std::string &text) {
    auto numbers = nlohmann::json::array();
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');) {
        const auto number = parse_number<double>(part);
        numbers.push_back(number ? nlohmann::json(*number) : nlohmann::json(part));
    }
    return numbers;
}

nlohmann::json read_value(const std::string &option, const std::string &text, const ValueRule &rule) {
    nlohmann::json value = text;
    if (rule.form == ValueRule::Form::numbers)
        value = numbers_of(text);
    else if (const auto whole = parse_number<std::uint64_t>(text); whole && rule.form != ValueRule::Form::name)
        value = *whole;
    else if (const auto real = parse_number<double>(text); real && rule.form != ValueRule::Form::name)
        value = *real;
    try {
        check(rule, value, {});
    } catch (const pt::JsonRefusal &refusal) {
        throw CLI::ValidationError(option, refusal.what());
    }
    return value;
}

CLI::Option *add_value(CLI::App &command, const std::string &name, const ValueRule &rule,
                       std::function<void(const nlohmann::json &)> store, const std::string &help) {
    const auto read = [name, rule, store = std::move(store)](const std::string &text) {
        store(read_value(name, text, rule));
    };
    return command.add_option_function<std::string>(name, read, help)->type_name(type_name(rule));
}

CLI::Option *add_text(CLI::App &command, const std::string &name, std::string &target, const std::string &value,
                      const std::string &help) {
    return command.add_option(name, target, help)->type_name(value);
}

CLI::Option *add_device(CLI::App &command, std::string &device) {
    return add_text(command, "--device", device, "INDEX|UUID|NAME|gpu|cpu|all",
                    "Index or UUID from `pt devices`, or several (0,1), or part of a name (default: the best one)");
}

CLI::Option *add_shader_dir(CLI::App &command, std::string &shader_dir) {
    return add_text(command, "--shader-dir", shader_dir, "DIR",
                    "Compile the kernels from the GLSL files in DIR, edited copies of the project's shaders/");
}

CLI::Option *add_quiet(CLI::App &command, bool &quiet) {
    return command.add_flag("-q,--quiet", quiet, "Print errors only");
}

std::shared_ptr<CLI::Formatter> help_formatter() {
    return std::make_shared<HelpFormatter>();
}

std::vector<std::string> command_names(const CLI::App &program) {
    std::vector<std::string> names;
    for (const CLI::App *command : program.get_subcommands([](const CLI::App *) { return true; }))
        names.push_back(command->get_name());
    return names;
}

std::string usage_reason(const CLI::App &program, const CLI::ParseError &error) {
    const std::vector<CLI::App *> parsed = program.get_subcommands();
    if (parsed.empty())
        return reason_of(program, error) + " (see pt --help)";
    const CLI::App &command = *parsed.front();
    const std::string see = " (see pt " + command.get_name() + " --help)";
    const std::vector<std::string> before = program.remaining();
    if (!before.empty())
        return before.front() + ": must come after the command" + see;
    return reason_of(command, error) + see;
}

} // namespace cli
