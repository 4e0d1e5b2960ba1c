// Owns the measurements of `pt selftest`: functions, scenes and splits on one device.
// Called by selftest_command.
#pragma once

#include "cli/base/context.h"
#include "cli/selftest/selftest_check.h"

#include <vector>

namespace cli {

// Throws Failure if the device does; what it computes wrongly is for the checks to tell.
std::vector<SelftestCheck> run_selftest_checks(const Context &context);

} // namespace cli
