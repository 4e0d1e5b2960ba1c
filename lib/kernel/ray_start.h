// Where camera rays start in narrow views of what is far away, and parallel ones in any view.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "lib/scene/scene.h"
#include "lib/tree/sphere_tree.h"

namespace pt {

// The camera with its position moved ahead, along its axis, to where the first surface in view may be, if the view is
// so narrow that the rounding of directions and of far coordinates would show. The kernel's coordinates begin there,
// and its rays on the plane across the view there: the same rays, known to the rounding of what is in view instead of
// that of its distance. Parallel rays start on such a plane in any case, on the disc about the image there
// (start_radius). tree: over further spheres, or NULL. Throws
// PT_ERROR_UNSUPPORTED if a view of parallel rays is too wide.
Camera starting_ahead(const Scene &scene, const SphereTree *tree, const Camera &camera, const RenderSettings &settings);

} // namespace pt
