// The man page of a command, in the macros of man(7).
#pragma once

#include "cli/help/command_text.h"

#include <string>

namespace cli {

// date: of the page's foot, may be empty. program: what all belongs to, for the references.
std::string man_page(const CommandText &command, const CommandText &program, const std::string &version,
                     const std::string &date);

} // namespace cli
