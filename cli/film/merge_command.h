// The command `pt merge`: films of one picture in, images and their sum out.
#pragma once

#include "cli/film/merge_options.h"

namespace cli {

// Returns the exit code; throws Failure.
int run_merge(const MergeOptions &options);

} // namespace cli
