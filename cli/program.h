#pragma once

namespace cli {

// Runs the command and returns its exit code. Unknown names run `pt-NAME`, as in git. Throws Failure.
int run_program(int argument_count, char **arguments);

} // namespace cli
