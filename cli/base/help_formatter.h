// The help of commands: CLI11's, broken into lines of 100 characters.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace cli {

class HelpFormatter : public CLI::Formatter {
public:
    HelpFormatter();

    std::string make_help(const CLI::App *command, std::string name, CLI::AppFormatMode mode) const override;
    std::string make_option(const CLI::Option *option, bool is_positional) const override;
    std::string make_option_opts(const CLI::Option *option) const override;
    std::string make_subcommand(const CLI::App *command) const override;
    std::string make_footer(const CLI::App *command) const override; // paragraphs; indented lines are rows of a table
};

} // namespace cli
