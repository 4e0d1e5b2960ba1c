#pragma once

#include "lib/view/seen_scene.h"

namespace pt {

// A scene without twins. Twins have surfaces that float32 cannot distinguish. Only the first of them is kept, because
// otherwise rounding would choose one of the twins for each ray of a path, and light would count twice or never.
struct DistinctScene {
    SeenScene seen;
    bool close_lamps;
    bool close_planes; // two planes nearly coincide
};

DistinctScene without_twins(SeenScene seen);

} // namespace pt
