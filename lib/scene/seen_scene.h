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
    double distance;        // distance of the center as the shutter opens
    std::uint32_t material; // index into Scene::materials
    std::uint32_t index;    // into Scene::spheres
    bool emits;
    bool hidden;
    bool is_flat; // held as a plane with a curvature

    SeenSphere(const Sphere &sphere, const Material &of_sphere, const Camera &camera, std::uint32_t of_index = 0);

    // The camera's height above the surface as the shutter opens; negative inside.
    double height() const { return distance - radius; }
};

// A plane, or a huge sphere as a slightly curved plane. For x relative to the camera and y = x + offset * normal:
// dot(normal, y) + curvature / 2 * dot(y, y) = 0 as the shutter opens.
struct CurvedPlane {
    glm::dvec3 normal; // unit vector at the point nearest to the camera; outward for a sphere
    double offset;     // signed distance of the camera, positive on the normal's side
    double curvature;  // 1 / radius; 0 for a plane
    glm::dvec3 way;    // while the shutter is open
    std::uint32_t material;
    std::uint32_t index; // into Scene::planes, or with a curvature Scene::spheres
    bool hidden = false;
};

// Turns the normal towards the camera. index: into Scene::planes.
CurvedPlane curved_plane(const Plane &plane, const Material &of_plane, const Camera &camera, std::uint32_t index = 0);

// sphere.is_flat must hold. By center and radius in float32 its surface would be off by 2^-24 of the radius, this way
// by 2^-24 of the scene's size.
CurvedPlane curved_plane(const SeenSphere &sphere);

// Keeps the scene's order.
struct SeenScene {
    std::vector<SeenSphere> spheres;
    std::vector<CurvedPlane> planes; // flat ones

    template <typename Is>
    bool any_surface(const Is &is) const {
        return std::ranges::any_of(spheres, is) || std::ranges::any_of(planes, is);
    }
};

SeenScene seen_scene(const Scene &scene, const Camera &camera);

// Throws PT_ERROR_UNSUPPORTED if a sphere that must be held as a plane moves too far. seen: of scene and camera.
// camera: where rays start (lib/kernel/ray_start.h).
void require_held_motions(const SeenScene &seen, const Scene &scene, const Camera &camera);

// Whether parallel rays may start on both sides of a surface, or float32 cannot tell. slack: additional distance.
bool divides_start(const MovingBall &ball, const Camera &camera, double slack = 0.0);
bool divides_start(const CurvedPlane &flat, const Camera &camera);

} // namespace pt
