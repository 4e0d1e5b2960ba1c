// One rendering on a context: from a scene to the files of its picture.
#pragma once

#include "cli/base/context.h"
#include "cli/render/outcome.h"
#include "cli/render/render_observer.h"
#include "cli/render/render_task.h"

#include <chrono>

namespace cli {

// For the report: when all began, and when the context began to be made ready.
struct RenderTimes {
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point create_start{};
};

// Hands scene and settings over, takes samples and writes the files. A signal stops it with the samples done so far;
// so does superseded(), but then nothing is written. Throws Failure.
Outcome render_picture(const Context &context, const RenderTask &task, const RenderTimes &times,
                       const Stop &superseded);

} // namespace cli
