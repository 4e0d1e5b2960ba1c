// A scene as the camera sees it while the shutter is open: every sphere and plane relative to it.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/moving_ball.h"
#include "lib/scene/scene.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pt {

struct SeenSphere : MovingBall {
    double distance;        // of the centre as the shutter opens
    std::uint32_t material; // index into Scene::materials
    std::uint32_t index;    // into Scene::spheres
    bool emits;
    bool hidden;  // from the camera
    bool is_flat; // so large that it is held better as a plane with a curvature

    SeenSphere(const Sphere &sphere, const Material &of_sphere, const Camera &camera, std::uint32_t of_index = 0);

    // Height of the camera above the surface as the shutter opens; negative inside.
    double height() const { return distance - radius; }
};

// A plane, or a sphere so large that the scene sees it as a plane with a slight curvature. It is described by its point
// nearest to the camera, -offset * normal relative to the camera. With x relative to the camera and y = x + offset *
// normal, the surface is dot(normal, y) + curvature / 2 * dot(y, y) = 0, as the shutter opens.
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
// camera: those from which seen was made; the camera is where rays start (lib/kernel/ray_start.h).
void require_held_motions(const SeenScene &seen, const Scene &scene, const Camera &camera);

// Whether rays may start on both sides of a surface, or so close to it that float32 cannot tell; slack: how much
// farther away still counts. Relative to a camera with a start_radius. Perspective rays start at a point, which is
// never divided.
bool divides_start(const MovingBall &ball, const Camera &camera, double slack = 0.0);
bool divides_start(const CurvedPlane &flat, const Camera &camera);

} // namespace pt
