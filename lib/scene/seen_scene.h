// A scene as the camera sees it: every sphere and plane relative to it.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/curved_plane.h"
#include "lib/scene/scene.h"
#include "lib/scene/seen_sphere.h"

#include <algorithm>
#include <vector>

namespace pt {

// In the order of the scene.
struct SeenScene {
    std::vector<SeenSphere> spheres;
    std::vector<CurvedPlane> planes; // flat ones

    // Whether some sphere or plane has this property.
    template <typename Is>
    bool any_surface(const Is &is) const {
        return std::ranges::any_of(spheres, is) || std::ranges::any_of(planes, is);
    }
};

SeenScene seen_scene(const Scene &scene, const Camera &camera);

// Throws PT_ERROR_UNSUPPORTED if a sphere would have to be held as a plane but moves too far for that. scene and
// camera: those from which seen was made; the camera is where rays start (ray_start.h).
void require_held_motions(const SeenScene &seen, const Scene &scene, const Camera &camera);

} // namespace pt
