#pragma once

#include "lib/base/error.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "lib/view/prepared_scene.h"

#include <optional>

namespace pt {

// Finds the visible surface that rounding moves farthest in the image. Returns a rule with the cause and a remedy if it
// moves by more than a pixel.
std::optional<BrokenRule> displaced_surface(const PreparedScene &scene, const Camera &camera,
                                            const RenderSettings &settings);

} // namespace pt
