// Surfaces so near to each other that float32 cannot tell, or all but cannot tell, which of them a ray meets first.
#pragma once

#include "lib/scene/scene.h"
#include "lib/scene/seen_scene.h"

#include <cstdint>
#include <vector>

namespace pt {

// Indices of spheres in the order of their places along the line by which near ones are found. Sorting is most of the
// work, and what the camera sees has nearly the same order, whatever the camera.
std::vector<std::uint32_t> order_along_line(const std::vector<Sphere> &spheres);

// A scene with twins taken for one surface: of spheres, or of planes, that float32 cannot tell apart as the camera sees
// them the first of the array stands for all. Otherwise rounding would choose among them, differently for the rays of
// one path, and count light twice or never.
struct DistinctScene {
    SeenScene seen;
    bool close_lamps;  // some emitting sphere and another one differ by less than a quarter of their radii
    bool close_planes; // some planes differ by less than a 2^8th in direction and distance
};

// order: by order_along_line, of the spheres seen.
DistinctScene without_twins(SeenScene seen, const std::vector<std::uint32_t> &order);

} // namespace pt
