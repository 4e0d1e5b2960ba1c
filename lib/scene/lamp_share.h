// How likely it is that a direction, or a sample of a pixel, meets a lamp by chance.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/scene.h"

#include <optional>

namespace pt {

// The share of all directions from the camera that the smallest lamp covers as the shutter opens, of those lamps that
// give at least a hundredth of what all give there. Nothing if there is none to miss: lamps around the camera do not
// count, since all directions may meet them.
std::optional<double> smallest_lamp_share(const Scene &scene, const Camera &camera);

// How many pixels of an image of this size the smallest of these lamps covers in the middle of the view, of those whose
// centres lie in it, if nothing hides them. Nothing if there is none.
std::optional<double> pixels_of_smallest_lamp_in_view(const Scene &scene, const Camera &camera, std::uint32_t width,
                                                      std::uint32_t height);

} // namespace pt
