// Merges surfaces so close that float32 hardly tells which of them a ray meets first.
#pragma once

#include "lib/scene/seen_scene.h"

namespace pt {

// The first of several surfaces that float32 cannot tell apart from the camera stands for all. Otherwise rounding would
// choose differently for each ray of a path, and light would count twice or never.
struct DistinctScene {
    SeenScene seen;
    bool close_lamps;  // a lamp and another sphere differ by under a quarter of their radii
    bool close_planes; // two planes differ by under 2^-8 in direction and distance
};

DistinctScene without_twins(SeenScene seen);

} // namespace pt
