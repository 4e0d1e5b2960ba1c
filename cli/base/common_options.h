// Options that several commands share, and the reading of values for which CLI11 is too lax.
#pragma once

#include "cli/base/number.h"
#include "cli/base/suggestion.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cli {

// "best|random|sobol", of these names.
std::string alternatives(std::span<const std::string_view> names);

[[noreturn]] void refuse_option(const std::string &option, const std::string &rule, const std::string &text);

// CLI11 would read "-1" as the largest unsigned number and "010" as 8, so numbers are read here.
template <typename Number>
Number read_option_number(const std::string &option, const std::string &text, Number smallest) {
    const auto number = parse_number<Number>(text);
    if (!number || *number < smallest) {
        refuse_option(option,
                      "must be a whole number from " + std::to_string(smallest) + " to " +
                          std::to_string(std::numeric_limits<Number>::max()),
                      text);
    }
    return *number;
}

// A relative error, as a number or in per cent.
double read_target_error(const std::string &option, const std::string &text);

template <typename Number, typename Target>
CLI::Option *add_whole_number(CLI::App &command, const std::string &name, Target &target, Number smallest,
                              const std::string &help) {
    const auto read = [&target, name, smallest](const std::string &text) {
        target = read_option_number<Number>(name, text, smallest);
    };
    return command.add_option_function<std::string>(name, read, help)->type_name("N");
}

template <typename Target>
CLI::Option *add_real_number(CLI::App &command, const std::string &name, Target &target, double smallest,
                             double largest, const std::string &help) {
    const auto read = [&target, name, smallest, largest](const std::string &text) {
        const auto number = parse_number<double>(text);
        if (!number || *number < smallest || *number > largest) {
            refuse_option(name,
                          "must be a number from " + CLI::detail::to_string(smallest) + " to " +
                              CLI::detail::to_string(largest),
                          text);
        }
        target = *number;
    };
    return command.add_option_function<std::string>(name, read, help);
}

// find: std::optional<Value>(std::string_view).
template <typename Find>
auto read_name(const std::string &option, const std::string &text, Find find, const std::string &kind,
               std::span<const std::string_view> known) {
    const auto found = find(text);
    if (!found)
        throw CLI::ValidationError(option, unknown_name(kind, text, known));
    return *found;
}

template <typename Target, typename Find>
CLI::Option *add_name(CLI::App &command, const std::string &name, Target &target, Find find, const std::string &kind,
                      std::span<const std::string_view> known, const std::string &help) {
    const auto read = [&target, find, name, kind, known](const std::string &text) {
        target = read_name(name, text, find, kind, known);
    };
    return command.add_option_function<std::string>(name, read, help)->type_name(alternatives(known));
}

CLI::Option *add_size(CLI::App &command, std::optional<ImageSize> &size);
CLI::Option *add_max_path_length(CLI::App &command, std::optional<std::uint32_t> &max_path_length);
CLI::Option *add_seed(CLI::App &command, std::optional<std::uint64_t> &seed);
CLI::Option *add_device(CLI::App &command, std::string &device);
void add_reporting(CLI::App &command, std::string &progress, bool &quiet);

} // namespace cli
