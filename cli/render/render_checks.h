#pragma once

#include "cli/render/render_options.h"
#include "cli/render/render_task.h"

namespace cli {

// Throws Failure(ExitCode::usage) for options that contradict each other, unknown formats, and outputs that are also
// sources or other outputs.
void check_names(const RenderOptions &options);

// Throws Failure if the images need too much memory, or if an output cannot be written.
void check_outputs(const RenderTask &task);

} // namespace cli
