// Owns where a report goes: to a file, or to standard output if its name is "-".
// Called by the subcommands.
#pragma once

#include <string>
#include <string_view>

namespace cli {

// Standard input where a file is read, standard output where one is written. A file of that name is "./-".
inline constexpr std::string_view standard_stream = "-";

// The path may be empty: no report is wanted. Both throw Failure(ExitCode::file).
void check_report_file(const std::string &path); // all that can be known before the report is there
void write_report_file(const std::string &path, std::string_view text);

// Lines for people: on standard output, or on stderr if a report is to have that to itself.
void print_for_people(const std::string &lines, bool standard_output_is_taken);

} // namespace cli
