// What is said of an argument that a command does not know: which option or subcommand was probably meant.
#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace cli {

// `unknown option "--expsure", did you mean "--exposure"?` of the first argument that was left over when the command
// line was parsed; nothing if none was.
std::optional<std::string> unknown_argument(const CLI::App &command);

} // namespace cli
