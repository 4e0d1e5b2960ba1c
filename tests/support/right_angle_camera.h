// A camera whose view is twice as high as it is deep: of 90 degrees, level, at rest.
#pragma once

#include "lib/scene/camera.h"

constexpr pt::Camera right_angle_camera{.position = {1.0, 2.0, 3.0},
                                        .right = {1, 0, 0},
                                        .up = {0, 1, 0},
                                        .forward = {0, 0, -1},
                                        .tan_half_fov = 1.0,
                                        .shutter_open = 0.0,
                                        .shutter_close = 0.0};
