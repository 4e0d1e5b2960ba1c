// What surfaces that the camera does not see (PT_MATERIAL_HIDDEN_FROM_CAMERA) mean for where paths can go. Used by
// scene_features.
#pragma once

#include "lib/scene/moving_ball.h"
#include "lib/scene/seen_scene.h"
#include "lib/tree/sphere_tree.h"

namespace pt {

// Whether a ball lies apart from these, as from a ball (moving_ball.h).
bool lies_apart(const MovingBall &ball, const CurvedPlane &flat);
bool lies_apart(const MovingBall &ball, const PointBox &box);

// Whether a hidden sphere lies apart from all that the camera sees. Paths begin there, and so never get into the
// sphere. tree: NULL if there is none; all of it is seen.
bool lies_apart(const SeenSphere &hidden, const SeenScene &scene, const SphereTree *tree, const Camera &camera);

} // namespace pt
