// How far rounding moves surfaces in the picture.
#pragma once

#include "lib/base/error.h"
#include "lib/kernel/prepared_scene.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"

#include <optional>

namespace pt {

// The surface that rounding moves farthest, in pixels, of those in view; nothing if that is at most a pixel. Its field
// is the one whose value causes it, and the rule says what to do.
std::optional<BrokenRule> displaced_surface(const PreparedScene &scene, const Camera &camera,
                                            const RenderSettings &settings);

} // namespace pt
