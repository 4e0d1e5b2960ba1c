#pragma once

namespace cli {

// Runs the command and returns its exit code. As in git, unknown names run `pt-NAME`. Throws Failure.
int run_program(int argument_count, char **arguments);

} // namespace cli
