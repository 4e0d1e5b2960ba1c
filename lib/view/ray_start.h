#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "lib/scene/scene.h"
#include "lib/tree/sphere_tree.h"
#include "shaders/gpu_layout.h"

#include <functional>
#include <limits>

namespace pt {

// If the view is so narrow that rounding would be visible, moves the camera ahead to the first surface that may be in
// view. Rays then start on a plane there, and the plane's center is the origin of the kernel's coordinates. Parallel
// rays always start on such a plane, in a disc (start_radius). Throws PT_ERROR_UNSUPPORTED if a parallel view is too
// wide.
Camera starting_ahead(const Scene &scene, const SphereTree *tree, const Camera &camera, const RenderSettings &settings);

inline constexpr double out_of_view = std::numeric_limits<double>::infinity();

// Returns a function that gives a lower bound of a moving ball's depth.
std::function<double(const MovingBall &)> depths_in_view(const Camera &camera, const RenderSettings &settings);

// `camera` must come from starting_ahead().
gpu::CameraView camera_view(const Camera &camera, const RenderSettings &settings);

} // namespace pt
