// How likely a random direction is to meet a lamp.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/scene.h"

#include <optional>
#include <span>

namespace pt {

// The share of all directions from the camera that the smallest important lamp covers as the shutter opens. A lamp is
// important if it gives at least a hundredth of the light that arrives there. Nothing if no lamp can be missed: lamps
// that surround the camera do not count, since every direction may meet them.
std::optional<double> smallest_lamp_share(std::span<const Sphere> lamps, std::span<const Material> materials,
                                          const Camera &camera);

} // namespace pt
