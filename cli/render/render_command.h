// The command `pt render`: scene file and options in, images out.
#pragma once

#include "cli/render/render_options.h"

namespace cli {

// Returns the exit code; throws Failure.
int run_render(const RenderOptions &options);

} // namespace cli
