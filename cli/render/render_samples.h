// Owns the taking of samples by `pt render`: until there are enough, the target error is reached or they are to stop.
// Called by piecewise_render.
#pragma once

#include "cli/base/context.h"
#include "cli/base/progress.h"
#include "cli/scene/render_settings.h"

#include <functional>

namespace cli {

// Says that no more samples are to be taken: a signal has come, or nothing would become of them. True for good then.
using Stop = std::function<bool()>;

void take_samples(const Context &context, const SceneFile &file, const RenderSettings &settings, const Stop &stop,
                  Progress &progress);

} // namespace cli
