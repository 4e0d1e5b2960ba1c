// The help of a command on the terminal.
#pragma once

#include "cli/help/command_text.h"

#include <memory>
#include <string>

namespace CLI {
class FormatterBase;
}

namespace cli {

std::string help_text(const CommandText &command);

// With which CLI11 answers --help.
std::shared_ptr<CLI::FormatterBase> help_formatter();

} // namespace cli
