// The command `pt bench`: scene file and options in, a table of errors and times out.
#pragma once

#include "cli/bench/bench_options.h"

namespace cli {

// Returns the exit code; throws Failure.
int run_bench(const BenchOptions &options);

} // namespace cli
