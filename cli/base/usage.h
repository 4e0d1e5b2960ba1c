// The help of commands, broken into lines of 100 characters, and what is wrong with a command line, in its words.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace CLI {
class App;
class ParseError;
} // namespace CLI

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

// `unknown option "--expsure", did you mean "--exposure"?` of the first argument that was left over when the command
// line was parsed; nothing if none was.
std::optional<std::string> unknown_argument(const CLI::App &command);

// error: why CLI11 refused the program's command line. With where to read on.
std::string usage_reason(const CLI::App &program, const CLI::ParseError &error);

} // namespace cli
