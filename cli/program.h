// The program pt without what surrounds every program: see main.cpp. Apart, so that CLI11 is compiled with the options.
#pragma once

namespace cli {

// Runs the command that the arguments of main() name, and returns its exit code. `pt NAME ...` runs `pt-NAME ...` if
// NAME is not one of its own commands, as git and cargo do. Throws Failure.
int run_program(int argument_count, char **arguments);

} // namespace cli
