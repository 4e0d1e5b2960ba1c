// The option --watch of `pt render`: the picture is rendered again whenever its sources change, on one context.
#pragma once

#include "cli/render/render_context.h"
#include "cli/render/render_options.h"

namespace cli {

// Returns the exit code once a signal has come: 0 if it came while
// waiting. Throws Failure where no change of a source could help, and for the first picture where the fault is not in a
// scene or shader.
int watch(const RenderOptions &options, ValidationLog &log);

} // namespace cli
