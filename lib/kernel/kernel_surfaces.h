// The surfaces that one camera sees, in the order in which kernels number them. Made by gpu_scene.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/moving_ball.h"
#include "lib/scene/seen_scene.h"
#include "lib/tree/sphere_tree.h"

#include <cstdint>
#include <vector>

namespace pt {

// How many surfaces of each kind the camera does not see. None of them is in the tree.
struct HiddenCounts {
    std::uint32_t lamps;
    std::uint32_t skies;
    std::uint32_t others; // spheres that do not emit
    std::uint32_t planes;
};

// A scene without twins as the kernel has it: lamps, skies, other spheres, planes with curvature, planes; within each
// kind in the scene's order, except that hidden ones are the last lamps, the first skies, the last other spheres and
// the first planes. So what the camera sees is two ranges. A sky is an emitting sphere that holds the camera: paths
// cannot leave it, and from within it cannot be sampled. But a hidden one that lies apart from all that is seen is a
// lamp.
struct KernelSurfaces {
    std::vector<SeenSphere> spheres; // held by centre and radius
    std::vector<CurvedPlane> planes;
    std::uint32_t lamp_count;
    std::uint32_t sky_count;
    HiddenCounts hidden;
};

// Whether a ball lies apart from these, as from a ball (moving_ball.h).
bool lies_apart(const MovingBall &ball, const CurvedPlane &flat);
bool lies_apart(const MovingBall &ball, const PointBox &box);

// Whether a hidden sphere lies apart from all that the camera sees. Paths begin there, and so never get into the
// sphere. tree: NULL if there is none; all of it is seen.
bool lies_apart(const SeenSphere &hidden, const SeenScene &scene, const SphereTree *tree, const Camera &camera);

// tree: NULL if the scene has none.
KernelSurfaces kernel_surfaces(const SeenScene &distinct, const SphereTree *tree, const Camera &camera);

} // namespace pt
