// A level camera at rest with a vertical field of view of 90 degrees: the view is twice as high as it is deep.
#pragma once

#include "lib/scene/camera.h"

constexpr pt::Camera right_angle_camera{.position = {1.0, 2.0, 3.0},
                                        .right = {1, 0, 0},
                                        .up = {0, 1, 0},
                                        .forward = {0, 0, -1},
                                        .tan_half_fov = 1.0,
                                        .shutter_open = 0.0,
                                        .shutter_close = 0.0};
