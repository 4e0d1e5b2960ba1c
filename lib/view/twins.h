#pragma once

#include "lib/view/seen_scene.h"

namespace pt {

// Twins have surfaces that float32 cannot distinguish. Only the first of them is kept, because otherwise rounding would
// choose one of the twins for each ray of a path, and light would count twice or never. Sets close_lamps and
// close_planes.
SeenScene without_twins(SeenScene seen);

} // namespace pt
