// A scene relative to the camera, while the shutter is open.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/moving_ball.h"
#include "lib/scene/scene.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pt {

struct SeenSphere : MovingBall {
    double distance; // distance of the center as the shutter opens
    std::uint32_t material;
    std::uint32_t index;
    bool emits;
    bool hidden;
    bool is_flat; // whether the kernel treats it as a curved plane

    SeenSphere(const Sphere &sphere, const Material &of_sphere, const Camera &camera, std::uint32_t of_index = 0);

    // Distance of the camera from the surface as the shutter opens; negative inside.
    double height() const { return distance - radius; }
};

// A plane, or a huge sphere as a slightly curved plane. For x relative to the camera and y = x + offset * normal:
// dot(normal, y) + curvature / 2 * dot(y, y) = 0 as the shutter opens.
struct CurvedPlane {
    glm::dvec3 normal; // normal at the point nearest to the camera; outwards for a sphere
    double offset;     // distance of the camera from the surface, positive on the normal's side
    double curvature;  // 1 / radius; 0 for a plane
    glm::dvec3 way;
    std::uint32_t material;
    std::uint32_t index; // index into Scene::planes, or into Scene::spheres for a sphere
    bool hidden = false;
};

CurvedPlane curved_plane(const Plane &plane, const Material &of_plane, const Camera &camera, std::uint32_t index = 0);

// sphere.is_flat must be true.
CurvedPlane curved_plane(const SeenSphere &sphere);

struct SeenScene {
    std::vector<SeenSphere> spheres;
    std::vector<CurvedPlane> planes;
    bool close_lamps = false;
    bool close_planes = false;

    template <typename Is>
    bool any_surface(const Is &is) const {
        return std::ranges::any_of(spheres, is) || std::ranges::any_of(planes, is);
    }
};

SeenScene seen_scene(const Scene &scene, const Camera &camera);

// Throws PT_ERROR_UNSUPPORTED if a nearly flat sphere moves too far. `camera` is the start of rays (projection.h).
void require_held_motions(const SeenScene &seen, const Scene &scene, const Camera &camera);

// Like divides_start() for balls (lib/scene/moving_ball.h).
bool divides_start(const CurvedPlane &flat, const Camera &camera);

} // namespace pt
