// Surfaces so near to each other that float32 cannot tell, or all but cannot tell, which of them a ray meets first. Used
// by RenderDevice and scene_features.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/scene.h"

namespace pt {

// The scene with twins taken for one surface: of spheres, or of planes, that float32 cannot tell apart as the camera sees
// them the first of the array stands for all. Otherwise rounding would choose among them, differently for the rays of one
// path, and count light twice or never.
Scene without_twins(const Scene &scene, const Camera &camera);

// Whether some emitting sphere and another one differ by less than a quarter of their radii. Twins are not meant: such
// scenes have none.
bool has_close_lamps(const Scene &scene, const Camera &camera);

// Whether some planes differ by less than a 2^8th in direction and distance. Again twins are not meant.
bool has_close_planes(const Scene &scene, const Camera &camera);

} // namespace pt
