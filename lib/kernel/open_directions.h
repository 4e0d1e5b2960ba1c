// How open a scene is: whether light paths soon leave it, or go on until they are as long as they may be.
#pragma once

#include "lib/scene/curved_plane.h"

#include <span>

namespace pt {

// The share of all directions in which a ray meets none of the planes, wherever on the camera's side of them it starts:
// those that lead away from each. By 512 directions spread evenly. Planes must be flat.
double open_directions(std::span<const CurvedPlane> planes);

} // namespace pt
