// The loop of `pt render`: samples are taken in steps, between which observers look at what there is. However they are
// split, the image has the same bits.
#pragma once

#include "cli/base/context.h"
#include "cli/render/render_observer.h"
#include "cli/scene/render_settings.h"
#include "cli/scene/scene_file.h"

#include <span>

namespace cli {

// From the samples that the context has on, until there are enough, the target error is reached or an observer stops
// it. The target error is looked at by the library, at counts that do not depend on the steps. Throws Failure.
void run_render_loop(const Context &context, const SceneFile &file, const RenderSettings &settings,
                     std::span<RenderObserver *const> observers);

} // namespace cli
