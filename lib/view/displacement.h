#pragma once

#include "lib/base/error.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "lib/view/prepared_scene.h"

#include <optional>

namespace pt {

// Returns the visible surface that rounding moves farthest, if it moves by more than a pixel. The rule names the cause
// and a remedy.
std::optional<BrokenRule> displaced_surface(const PreparedScene &scene, const Camera &camera,
                                            const RenderSettings &settings);

} // namespace pt
