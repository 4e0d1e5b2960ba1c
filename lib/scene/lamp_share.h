// How likely it is that a direction meets a lamp by chance.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/scene.h"

#include <optional>
#include <span>

namespace pt {

// The share of all directions from the camera that the smallest lamp covers as the shutter opens, of those lamps that
// give at least a hundredth of what all give there. Nothing if there is none to miss: lamps around the camera do not
// count, since all directions may meet them.
std::optional<double> smallest_lamp_share(std::span<const Sphere> lamps, std::span<const Material> materials,
                                          const Camera &camera);

} // namespace pt
