// Where parallel camera rays start: on a disc, which surfaces may divide.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/curved_plane.h"
#include "lib/scene/moving_ball.h"

namespace pt {

// Whether rays may start on either side of a surface, or so near to it that float32 cannot tell; slack: how much
// farther still. Relative to the camera, which has a start_radius. Of a point, on which perspective rays start, nothing
// is said: not divided.
bool divides_start(const MovingBall &ball, const Camera &camera, double slack = 0.0);
bool divides_start(const CurvedPlane &flat, const Camera &camera);

} // namespace pt
