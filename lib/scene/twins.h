// Surfaces so close to each other that float32 can hardly tell which of them a ray meets first.
#pragma once

#include "lib/scene/seen_scene.h"

namespace pt {

// A scene in which twins are merged. Among spheres, or planes, that float32 cannot tell apart from where the camera is,
// the first in the array stands for all. Otherwise rounding would choose among them, differently for each ray of a
// path, and light would be counted twice or never.
struct DistinctScene {
    SeenScene seen;
    bool close_lamps;  // some emitting sphere and another one differ by less than a quarter of their radii
    bool close_planes; // some planes differ by less than a 2^8th in direction and distance
};

DistinctScene without_twins(SeenScene seen);

} // namespace pt
