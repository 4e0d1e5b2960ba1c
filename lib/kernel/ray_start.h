// Where camera rays start: ahead of the camera in narrow views of distant things, and with parallel rays.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "lib/scene/scene.h"
#include "lib/tree/sphere_tree.h"
#include "shaders/gpu_layout.h"

#include <functional>
#include <limits>

namespace pt {

// Moves the camera ahead to the first surface that may be in view, if the view is so narrow that the rounding of
// directions and distant coordinates would show. The kernel's coordinates begin there, and rays start on the plane
// across the view there: the same rays, rounded by the scale of the visible things instead of their distance. Parallel
// rays always start on such a plane, on the disc around the image (start_radius). tree: further spheres, or NULL.
// Throws PT_ERROR_UNSUPPORTED if a view with parallel rays is too wide.
Camera starting_ahead(const Scene &scene, const SphereTree *tree, const Camera &camera, const RenderSettings &settings);

// A depth of what the camera does not see.
inline constexpr double out_of_view = std::numeric_limits<double>::infinity();

// The depth of the nearest point that a ball takes up on its way and that the camera may see, or less.
std::function<double(const MovingBall &)> depths_in_view(const Camera &camera, const RenderSettings &settings);

// Such a camera as kernels read it.
gpu::CameraView camera_view(const Camera &camera, const RenderSettings &settings);

} // namespace pt
