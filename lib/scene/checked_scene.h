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

// Throws PT_ERROR_INVALID_SCENE with all broken rules.
CheckedScene checked_scene(const pt_scene &scene, WorkProgress &progress);

} // namespace pt
