// Whether an estimate of the error can know of all lamps. Used by Renderer.
#pragma once

#include "lib/film/error_estimate.h"
#include "lib/render/small_lamps.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"

#include <cstdint>

namespace pt {

// Whether some lamp or lobe is found by chance alone, and so small that few of so many samples, of all pixels, have met
// it, if any.
bool may_miss_lamps(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings,
                    std::uint64_t samples);

// States at least the error that is expected of lamps in view which samples have hardly met, given as means over the
// image's values. An error for which that is more than the samples show is uncertain.
void take_in_unmet_lamps(ErrorEstimate &error, const UnmetSquares &unmet);

} // namespace pt
