// A scene that obeys the rules of pt.h. Its spheres still lie in the caller's memory.
#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/scene.h"
#include "lib/scene/sphere_source.h"

#include <pt/pt.h>

#include <vector>

namespace pt {

struct CheckedScene {
    std::vector<Material> materials;
    SphereSource spheres;
    std::vector<Plane> planes;
};

// Checks a scene whose struct_size is settled, with its share of the progress of a longer call. Throws
// PT_ERROR_INVALID_SCENE with all broken rules.
CheckedScene checked_scene(const pt_scene &scene, WorkProgress &progress);

} // namespace pt
