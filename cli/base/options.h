// What all commands have of the command line: options that several share, the reading of values for which CLI11 is too
// lax (it takes "-1" for the largest unsigned number and "010" for 8), the help, and what is wrong with a command line.
#pragma once

#include "cli/base/json.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace cli {

// What the program does for a command: returns the exit code, or throws Failure.
using Run = std::function<int()>;

// Adds a command to the program. When the command line names it, `chosen` becomes `run`. notes: text of the help that
// follows the options.
CLI::App &add_command(CLI::App &program, Run &chosen, const std::string &name, const std::string &description,
                      const std::string &notes, Run run);

// The same for a command that is run with options, which are read from the command line.
template <typename Options>
std::pair<CLI::App &, Options &> add_command(CLI::App &program, Run &chosen, const std::string &name,
                                             const std::string &description, const std::string &notes,
                                             int (*run)(const Options &)) {
    const auto options = std::make_shared<Options>();
    return {add_command(program, chosen, name, description, notes, [options, run] { return run(*options); }), *options};
}

[[noreturn]] void refuse_option(const std::string &option, const std::string &rule, const std::string &text);

// Reads the value of a text by a rule. Throws CLI::ValidationError.
nlohmann::json read_value(const std::string &option, const std::string &text, const ValueRule &rule);

// store: receives the value, which keeps the rule.
CLI::Option *add_value(CLI::App &command, const std::string &name, const ValueRule &rule,
                       std::function<void(const nlohmann::json &)> store, const std::string &help);

// target: a Number, or an optional one.
template <typename Number, typename Target>
CLI::Option *add_number(CLI::App &command, const std::string &name, const ValueRule &rule, Target &target,
                        const std::string &help) {
    return add_value(
        command, name, rule, [&target](const nlohmann::json &value) { target = value.get<Number>(); }, help);
}

// find: the value of a name, as std::optional. kind: what the names stand for, in messages.
template <typename Target, typename Find>
CLI::Option *add_name(CLI::App &command, const std::string &name, Target &target, Find find, std::string_view kind,
                      std::span<const std::string_view> names, const std::string &help) {
    return add_value(
        command, name, {.form = ValueRule::Form::name, .kind = kind, .names = names},
        [&target, find](const nlohmann::json &value) { target = find(value.get_ref<const std::string &>()).value(); },
        help);
}

// A file, or another text. value: the placeholder in the help.
CLI::Option *add_text(CLI::App &command, const std::string &name, std::string &target, const std::string &value,
                      const std::string &help);

CLI::Option *add_device(CLI::App &command, std::string &device);
CLI::Option *add_shader_dir(CLI::App &command, std::string &shader_dir);
CLI::Option *add_quiet(CLI::App &command, bool &quiet);

// Breaks the help into lines of 100 characters.
std::shared_ptr<CLI::Formatter> help_formatter();

// error: why CLI11 refused the program's command line. With where to read on.
std::string usage_reason(const CLI::App &program, const CLI::ParseError &error);

std::vector<std::string> command_names(const CLI::App &program);

} // namespace cli
