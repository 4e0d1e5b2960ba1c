#pragma once

#include "lib/film/error_estimate.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "lib/view/lamp.h"
#include "lib/view/small_lamps.h"

#include <cstdint>
#include <span>

namespace pt {

// Returns the fraction of directions from the camera that the smallest important lamp covers as the shutter opens.
// Important lamps give at least a hundredth of the light at the camera. Lamps around the camera are ignored. Without
// other lamps the result is 1.
double smallest_lamp_share(std::span<const Lamp> lamps);

bool may_miss_lamps(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings,
                    std::uint64_t samples);

// Raises the stated error to the error expected from lamps in view that have too few samples. If the expected error
// comes from few hits and exceeds half of the stated error, the stated error becomes uncertain.
void take_in_unmet_lamps(ErrorEstimate &error, const UnmetSquares &unmet, double value_count);

} // namespace pt
