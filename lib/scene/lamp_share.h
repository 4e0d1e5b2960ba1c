// How likely it is that a direction meets a lamp by chance.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/scene.h"

namespace pt {

// The share of all directions from the camera that the smallest lamp covers, as the shutter opens: 1 if there is none.
// Lamps around the camera do not count, since all directions may meet them.
double smallest_lamp_share(const Scene &scene, const Camera &camera);

} // namespace pt
