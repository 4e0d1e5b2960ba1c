// Where a report goes: to a file, or to standard output if its name is "-".
#pragma once

#include <string>
#include <string_view>

namespace cli {

// Standard input where a file is read, standard output where one is written. A file of that name is "./-".
inline constexpr std::string_view standard_stream = "-";

// The path may be empty: no report is wanted. Both throw Failure(ExitCode::file).
void check_report_file(const std::string &path); // what can be checked before there is a report
void write_report_file(const std::string &path, std::string_view text);

// Lines for people: on standard output, or on stderr if a report goes to standard output.
void print_for_people(const std::string &lines, bool standard_output_is_taken);

} // namespace cli
