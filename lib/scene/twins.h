// Merges surfaces so close that float32 can hardly tell which of them a ray meets first.
#pragma once

#include "lib/scene/seen_scene.h"

namespace pt {

// The first of several spheres, or planes, that float32 cannot tell apart from the camera stands for all. Otherwise
// rounding would choose differently for each ray of a path, and light would count twice or never.
struct DistinctScene {
    SeenScene seen;
    bool close_lamps;  // a lamp and another sphere differ by less than a quarter of their radii
    bool close_planes; // two planes differ by less than 2^-8 in direction and distance
};

DistinctScene without_twins(SeenScene seen);

} // namespace pt
