// Parallel camera rays start on a disc. A surface may cut that disc in two.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/curved_plane.h"
#include "lib/scene/moving_ball.h"

namespace pt {

// Whether rays may start on both sides of a surface, or so close to it that float32 cannot tell; slack: how much
// farther away still counts. Relative to a camera with a start_radius. Perspective rays start at a point, which is
// never divided.
bool divides_start(const MovingBall &ball, const Camera &camera, double slack = 0.0);
bool divides_start(const CurvedPlane &flat, const Camera &camera);

} // namespace pt
