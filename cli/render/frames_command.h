// The option --frames of `pt render`: the frames of an animation, one after the other on one context.
#pragma once

#include "cli/render/render_context.h"
#include "cli/render/render_options.h"

namespace cli {

// Returns the exit code; throws Failure. A frame that a signal stops is
// not written: each file is a whole frame.
int render_frames(const RenderOptions &options, ValidationLog &log);

} // namespace cli
