// Reads whole files, and checks that they are text.
#pragma once

#include <string>
#include <string_view>

namespace cli {

// Both throw Failure(ExitCode::file) with the system's reason.
std::string read_file(const std::string &path);
std::string read_standard_input();

// The text of a file without the byte order mark that some editors put in front. Throws Failure(ExitCode::scene) for
// UTF-16 and for files with a NUL byte, which readers of text would take for their end.
std::string_view require_text(std::string_view contents, const std::string &path);

// Line and column of what follows the given part of a text, as "3:14". Both count from 1; columns are bytes.
std::string line_and_column(std::string_view before);

} // namespace cli
