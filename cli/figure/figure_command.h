// The command `pt figure`: a picture of particles, without a scene file.
#pragma once

#include "cli/figure/figure_options.h"

namespace cli {

// Returns the exit code; throws Failure.
int run_figure(const FigureOptions &options);

} // namespace cli
