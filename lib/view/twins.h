#pragma once

#include "lib/view/seen_scene.h"

namespace pt {

// A scene without twins, whose surfaces float32 cannot distinguish. Only the first twin is kept. Otherwise rounding
// would choose one of the twins for each ray of a path, and light would count twice or never.
struct DistinctScene {
    SeenScene seen;
    bool close_lamps;
    bool close_planes; // two planes differ by less than 2^-8 in direction and distance
};

DistinctScene without_twins(SeenScene seen);

} // namespace pt
