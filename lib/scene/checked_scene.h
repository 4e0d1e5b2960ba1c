// A scene that obeys the rules of pt.h and whose spheres are still where the caller has them.
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

// Of a scene whose struct_size is settled. Throws PT_ERROR_INVALID_SCENE with all broken rules.
CheckedScene checked_scene(const pt_scene &scene);

// The same, as the first stage of a work.
CheckedScene checked_scene(const pt_scene &scene, WorkProgress &progress);

} // namespace pt
