// The measurements of `pt selftest`: functions, scenes and splits on one device.
#pragma once

#include "cli/base/context.h"
#include "cli/selftest/selftest_check.h"

#include <vector>

namespace cli {

// Throw Failure if a call fails; wrong results are failed checks.
std::vector<SelftestCheck> run_selftest_checks(const Context &context);
std::vector<SelftestCheck> run_direction_checks(const Context &context);

} // namespace cli
