#pragma once

#include "lib/scene/seen_scene.h"

namespace pt {

// Float32 cannot tell the surfaces of twins apart. Only the first of them stays. Otherwise rounding would choose
// differently for each ray of a path, and light would count twice or never.
struct DistinctScene {
    SeenScene seen;
    bool close_lamps;
    bool close_planes; // two planes differ by less than 2^-8 in direction and distance
};

DistinctScene without_twins(SeenScene seen);

} // namespace pt
