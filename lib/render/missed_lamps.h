// Whether an error estimate can know about all lamps.
#pragma once

#include "lib/film/error_estimate.h"
#include "lib/render/small_lamps.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"

#include <cstdint>
#include <span>

namespace pt {

// The share of directions from the camera that the smallest important lamp covers as the shutter opens; 1 if none can
// be missed, since lamps around the camera do not count. Important lamps give at least a hundredth of the light there.
double smallest_lamp_share(std::span<const Sphere> lamps, std::span<const Material> materials, const Camera &camera);

// Whether a lamp or lobe is found only by chance and too small for these samples to have hit it often.
bool may_miss_lamps(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings,
                    std::uint64_t samples);

// Raises the stated error of value_count values to the one expected for lamps in view with too few samples. If that
// rests on few hits and exceeds half of the error that samples show, the error is uncertain.
void take_in_unmet_lamps(ErrorEstimate &error, const UnmetSquares &unmet, double value_count);

} // namespace pt
