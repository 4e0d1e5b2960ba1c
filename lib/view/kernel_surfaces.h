#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/moving_ball.h"
#include "lib/tree/sphere_tree.h"
#include "lib/view/seen_scene.h"

#include <cstdint>
#include <vector>

namespace pt {

struct HiddenCounts {
    std::uint32_t lamps;
    std::uint32_t skies;
    std::uint32_t others;
    std::uint32_t planes;
};

// The order is lamps, skies, other spheres, curved planes, planes. A sky is an emitting sphere around the camera, which
// cannot be sampled from inside. Within each kind visible surfaces keep the scene's order. Hidden surfaces are the last
// lamps, first skies, last other spheres and first planes, so that the visible spheres form two ranges. A hidden sky
// that lies apart from all visible surfaces is a lamp.
struct KernelSurfaces {
    std::vector<SeenSphere> spheres;
    std::vector<CurvedPlane> planes;
    std::uint32_t lamp_count;
    std::uint32_t sky_count;
    HiddenCounts hidden;
};

bool lies_apart(const MovingBall &ball, const CurvedPlane &flat);
bool lies_apart(const MovingBall &ball, const PointBox &box);

// Whether a hidden sphere lies apart from all visible surfaces.
bool lies_apart(const SeenSphere &hidden, const SeenScene &scene, const SphereTree *tree, const Camera &camera);

KernelSurfaces kernel_surfaces(const SeenScene &distinct, const SphereTree *tree, const Camera &camera);

} // namespace pt
