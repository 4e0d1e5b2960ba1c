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

// Whether a lamp in view is so small that so many samples of a pixel are expected to meet it a few times at the most,
// unless something hides it: the samples of a single pixel do not tell how bright that is.
bool may_miss_lamps_in_view(const Scene &scene, const Camera &camera, const RenderSettings &settings,
                            std::uint64_t samples);

} // namespace pt
