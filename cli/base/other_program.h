// `pt NAME ...` runs `pt-NAME ...` where NAME is no command of the program's own, as git and cargo do.
#pragma once

#include <string_view>

namespace cli {

// Whether it may follow `pt-` in the name of a program: a file or a path does not.
bool may_name_program(std::string_view name);

// Replaces this process by `pt-NAME` from the first absolute folder of PATH that has it. Empty and relative entries are
// skipped, so that nothing of the current folder runs. arguments end with a null pointer, and begin with NAME. Returns
// only if there is no such program; throws Failure(ExitCode::file) for one that does not start.
void run_other_program(std::string_view name, char *const *arguments);

// How to install that one, as a continuation of a message; empty for those that do not come with this project.
std::string_view installation_of(std::string_view name);

} // namespace cli
