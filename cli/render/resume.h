// Takes the samples of a checkpoint over, so that a rendering goes on where another has ended.
#pragma once

#include "cli/base/context.h"
#include "cli/render/render_task.h"

#include <cstdint>
#include <string>

namespace cli {

// After pt_set_render. Returns how many samples a pixel there were: 0 if there is no such file yet, as where the run
// before was ended too early to write one. Throws Failure(ExitCode::usage) if the checkpoint is of another picture,
// which says what differs, or has samples that this run does not take.
std::uint32_t resume(const Context &context, const RenderTask &task);

} // namespace cli
