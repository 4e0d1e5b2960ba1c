// The command `pt tonemap`: the display side of a file of radiance once more, without rendering.
#pragma once

#include "cli/image/display_options.h"

#include <string>

namespace cli {

struct TonemapOptions {
    std::string input;
    std::string output;
    std::optional<ImageFormat> format; // of an output that is standard output
    DisplayOptions display;
    bool quiet = false;
};

extern const char *const tonemap_help;

// The options write into `options` when the command line is parsed, so it has to live as long as the command.
void add_tonemap_options(CLI::App &command, TonemapOptions &options);

// Returns the exit code; throws Failure.
int run_tonemap(const TonemapOptions &options);

} // namespace cli
