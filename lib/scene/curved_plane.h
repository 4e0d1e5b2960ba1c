// A plane, or a sphere so large that the scene sees it as a plane with a slight curvature. Used by scene_features and
// gpu_scene.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/scene.h"

#include <optional>

namespace pt {

// Held by its point nearest to the camera, -offset * normal relative to the camera: with x relative to the camera and
// y = x + offset * normal, the surface is dot(normal, y) + curvature / 2 * dot(y, y) = 0, as the shutter opens.
struct CurvedPlane {
    glm::dvec3 normal; // unit vector there; outward for a sphere
    double offset;     // signed distance of the camera from the surface, positive on the side of the normal
    double curvature;  // 1 / radius; 0 for a plane
    glm::dvec3 way;    // of the surface while the shutter is open
};

// With its normal towards the camera.
CurvedPlane curved_plane(const Plane &plane, const Camera &camera);

// For a sphere that is held better like this than by its centre and radius: in float32, those put its surface off by
// 2^-24 of the radius, this by 2^-24 of what the scene measures.
std::optional<CurvedPlane> curved_plane(const Sphere &sphere, const Material &material, const Camera &camera);

// Throws PT_ERROR_UNSUPPORTED if some sphere would have to be held like this but moves too far for it.
void require_held_motions(const Scene &scene, const Camera &camera);

} // namespace pt
