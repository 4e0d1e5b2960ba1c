// The commands `pt completion` and `pt man`, which print what the program says of itself for shells and for man(1).
#pragma once

#include "cli/help/command_text.h"

#include <string>

namespace cli {

struct CompletionOptions {
    std::string shell;
};

struct ManOptions {
    std::string command; // empty: of the program
};

extern const char *const completion_help;
extern const char *const man_help;

void add_completion_options(CLI::App &command, CompletionOptions &options);

// To be called when the program has all its commands.
void add_man_options(CLI::App &command, const CLI::App &program, ManOptions &options);

// Return the exit code.
int run_completion(const CompletionOptions &options, const CLI::App &program);
int run_man(const ManOptions &options, const CLI::App &program);

} // namespace cli
