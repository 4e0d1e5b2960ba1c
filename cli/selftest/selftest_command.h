// The command `pt selftest`: whether a device computes what it should.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace cli {

struct SelftestOptions {
    std::string device;
    std::string json;
    std::string shader_dir; // empty: the library's own kernels
    bool directions = false;
};

extern const char *const selftest_help;

// The options write into `options` when the command line is parsed, so it has to live as long as the command.
void add_selftest_options(CLI::App &command, SelftestOptions &options);

// Returns the exit code: ExitCode::internal if a check fails. Throws Failure.
int run_selftest(const SelftestOptions &options);

} // namespace cli
