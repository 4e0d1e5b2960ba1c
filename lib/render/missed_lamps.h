// Whether an estimate of the error can know of all lamps. Used by Renderer.
#pragma once

#include "lib/render/render_settings.h"
#include "lib/scene/camera.h"
#include "lib/scene/scene.h"

#include <cstdint>

namespace pt {

// Whether some lamp is found by chance alone, and so small that few of so many samples, of all pixels, have met it, if
// any.
bool may_miss_lamps(const Scene &scene, const Camera &camera, const RenderSettings &settings, std::uint64_t samples);

} // namespace pt
