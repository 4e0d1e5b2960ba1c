// Whether an estimate of the error can know about all lamps. Used by Renderer.
#pragma once

#include "lib/film/error_estimate.h"
#include "lib/render/small_lamps.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"

#include <cstdint>
#include <span>

namespace pt {

// The share of all directions from the camera that the smallest important lamp covers as the shutter opens. A lamp is
// important if it gives at least a hundredth of the light that arrives there. 1 if no lamp can be missed: lamps that
// surround the camera do not count, since every direction may meet them.
double smallest_lamp_share(std::span<const Sphere> lamps, std::span<const Material> materials, const Camera &camera);

// Whether some lamp or lobe is found only by chance and is so small that few of all these samples, if any, have met it.
bool may_miss_lamps(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings,
                    std::uint64_t samples);

// Raises the stated error of so many values to at least what is expected of lamps in view for which there are too few
// samples. If it rests on few meetings, and is more than half of what the samples show, the error is uncertain.
void take_in_unmet_lamps(ErrorEstimate &error, const UnmetSquares &unmet, double value_count);

} // namespace pt
