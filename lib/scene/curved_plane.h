// A plane, or a sphere so large that the scene sees it as a plane with a slight curvature.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/scene.h"
#include "lib/scene/seen_sphere.h"

#include <cstdint>

namespace pt {

// Described by its point nearest to the camera, -offset * normal relative to the camera. With x relative to the camera
// and y = x + offset * normal, the surface is dot(normal, y) + curvature / 2 * dot(y, y) = 0, as the shutter opens.
struct CurvedPlane {
    glm::dvec3 normal;      // unit vector there; outward for a sphere
    double offset;          // signed distance of the camera from the surface, positive on the side of the normal
    double curvature;       // 1 / radius; 0 for a plane
    glm::dvec3 way;         // of the surface while the shutter is open
    std::uint32_t material; // index into Scene::materials
    std::uint32_t index;    // into Scene::planes or, of what has a curvature, into Scene::spheres
    bool hidden = false;    // from the camera
};

// A plane, with its normal turned towards the camera. index: into Scene::planes.
CurvedPlane curved_plane(const Plane &plane, const Material &of_plane, const Camera &camera, std::uint32_t index = 0);

// A sphere that is_flat. Held by centre and radius in float32, its surface would be off by 2^-24 of the radius; held
// like this it is off by 2^-24 of the size of the scene.
CurvedPlane curved_plane(const SeenSphere &sphere);

} // namespace pt
