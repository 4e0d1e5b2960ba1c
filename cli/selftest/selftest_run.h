// The measurements of `pt selftest`: functions, scenes and splits on one device.
#pragma once

#include "cli/base/context.h"
#include "cli/selftest/selftest_check.h"

#include <vector>

namespace cli {

// Throws Failure if a call fails; wrong results are failed checks.
std::vector<SelftestCheck> run_selftest_checks(const Context &context);

} // namespace cli
