// The command `pt selftest`: whether a device computes what it should.
#pragma once

#include "cli/base/context.h"
#include "cli/selftest/selftest_scenes.h"

#include <nlohmann/json_fwd.hpp>
#include <pt/devices.h>
#include <pt/pt.h>

#include <string>
#include <vector>

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

struct SelftestReport {
    pt_device_info device;
    std::vector<SelftestCheck> checks;

    bool passed() const;
};

// The device, a line for every check, and the verdict.
std::string selftest_text(const SelftestReport &report);

nlohmann::ordered_json selftest_json(const SelftestReport &report);

// Throw Failure if a call fails; wrong results are failed checks.
std::vector<SelftestCheck> run_selftest_checks(const Context &context);
std::vector<SelftestCheck> run_direction_checks(const Context &context);

} // namespace cli
