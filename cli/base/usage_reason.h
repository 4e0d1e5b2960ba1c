// What is wrong with a command line, in the words of the help.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace cli {

// error: why CLI11 refused the program's command line. With where to read on.
std::string usage_reason(const CLI::App &program, const CLI::ParseError &error);

} // namespace cli
