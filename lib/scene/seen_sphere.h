// A sphere as the camera sees it while the shutter is open.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/moving_ball.h"
#include "lib/scene/scene.h"

#include <cstdint>

namespace pt {

// A ball from when the shutter opens until it closes, or all of a capsule, relative to the camera.
inline MovingBall seen_ball(const MovingBall &ball, const Camera &camera) {
    if (ball.swept)
        return {ball.open - camera.position, ball.way, ball.radius, true};
    return {ball.open + camera.shutter_open * ball.way - camera.position,
            (camera.shutter_close - camera.shutter_open) * ball.way, ball.radius};
}

struct SeenSphere : MovingBall {
    double distance;        // of the centre as the shutter opens
    std::uint32_t material; // index into Scene::materials
    std::uint32_t index;    // into Scene::spheres
    bool emits;
    bool hidden;  // from the camera
    bool is_flat; // so large that it is held better as a plane with a curvature (curved_plane.h)

    SeenSphere(const Sphere &sphere, const Material &of_sphere, const Camera &camera, std::uint32_t of_index = 0);

    // Height of the camera above the surface as the shutter opens; negative inside.
    double height() const { return distance - radius; }
};

// Whether its surface is so near that it has to be held as a plane, although it moves too far for that. camera: the one
// that sees it, placed where rays start.
bool moves_too_far(const SeenSphere &sphere, const Camera &camera);

} // namespace pt
