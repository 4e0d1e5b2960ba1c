// Common options. CLI11's own conversions would read "-1" as the largest unsigned number and "010" as 8.
#pragma once

#include "lib/scene_file/json_value.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace cli {

using pt::natural_number;
using pt::positive_number;
using pt::seconds_rule;
using pt::ValueRule;

using Run = std::function<int()>;

// When the command line names this command, `chosen` becomes `run`. The help ends with `notes`.
CLI::App &add_command(CLI::App &program, Run &chosen, const std::string &name, const std::string &description,
                      const std::string &notes, Run run);

template <typename Options>
std::pair<CLI::App &, Options &> add_command(CLI::App &program, Run &chosen, const std::string &name,
                                             const std::string &description, const std::string &notes,
                                             int (*run)(const Options &)) {
    const auto options = std::make_shared<Options>();
    return {add_command(program, chosen, name, description, notes, [options, run] { return run(*options); }), *options};
}

[[noreturn]] void refuse_option(const std::string &option, const std::string &rule, const std::string &text);

nlohmann::json read_value(const std::string &option, const std::string &text, const ValueRule &rule);

CLI::Option *add_value(CLI::App &command, const std::string &name, const ValueRule &rule,
                       std::function<void(const nlohmann::json &)> store, const std::string &help);

template <typename Number, typename Target>
CLI::Option *add_number(CLI::App &command, const std::string &name, const ValueRule &rule, Target &target,
                        const std::string &help) {
    return add_value(
        command, name, rule, [&target](const nlohmann::json &value) { target = value.get<Number>(); }, help);
}

// find() returns the value of a known name. `kind` describes the names in messages.
template <typename Target, typename Find>
CLI::Option *add_name(CLI::App &command, const std::string &name, Target &target, Find find, std::string_view kind,
                      std::span<const std::string_view> names, const std::string &help) {
    return add_value(
        command, name, {.form = ValueRule::Form::name, .kind = kind, .names = names},
        [&target, find](const nlohmann::json &value) { target = find(value.get_ref<const std::string &>()).value(); },
        help);
}

CLI::Option *add_text(CLI::App &command, const std::string &name, std::string &target, const std::string &value,
                      const std::string &help);

CLI::Option *add_device(CLI::App &command, std::string &device);
CLI::Option *add_shader_dir(CLI::App &command, std::string &shader_dir);
CLI::Option *add_quiet(CLI::App &command, bool &quiet);

std::shared_ptr<CLI::Formatter> help_formatter();

std::string usage_reason(const CLI::App &program, const CLI::ParseError &error);

std::vector<std::string> command_names(const CLI::App &program);

} // namespace cli
