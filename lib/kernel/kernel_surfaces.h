// The surfaces that one camera sees, in the kernels' order.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/moving_ball.h"
#include "lib/scene/seen_scene.h"
#include "lib/tree/sphere_tree.h"

#include <cstdint>
#include <vector>

namespace pt {

struct HiddenCounts {
    std::uint32_t lamps;
    std::uint32_t skies;
    std::uint32_t others; // spheres that do not emit
    std::uint32_t planes;
};

// Lamps, skies, other spheres, curved planes, planes, without twins. Each kind keeps the scene's order, but hidden ones
// are the last lamps, first skies, last other spheres and first planes, so that the camera sees two ranges. A sky is an
// emitting sphere around the camera, which cannot be sampled from inside. A hidden one apart from everything visible is
// a lamp.
struct KernelSurfaces {
    std::vector<SeenSphere> spheres; // held by center and radius
    std::vector<CurvedPlane> planes;
    std::uint32_t lamp_count;
    std::uint32_t sky_count;
    HiddenCounts hidden;
};

// Whether a ball lies apart, as in moving_ball.h.
bool lies_apart(const MovingBall &ball, const CurvedPlane &flat);
bool lies_apart(const MovingBall &ball, const PointBox &box);

// Whether a hidden sphere lies apart from everything visible, so that no path gets into it. tree: may be NULL.
bool lies_apart(const SeenSphere &hidden, const SeenScene &scene, const SphereTree *tree, const Camera &camera);

KernelSurfaces kernel_surfaces(const SeenScene &distinct, const SphereTree *tree, const Camera &camera);

} // namespace pt
