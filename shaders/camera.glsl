// Pinhole camera at the origin. Used by path.glsl.
#ifndef CAMERA_GLSL
#define CAMERA_GLSL

#include "gpu_layout.h"

// Unit direction through a point of the image: pixel (column, row) from the top left, place in it in [0, 1)^2. The
// pixel's distance from the image's centre is exact (a multiple of 1/2), so wide images lose nothing at their middle.
vec3 camera_direction(FrameConstants frame, uvec2 pixel, vec2 place)
{
    vec2 from_centre = 0.5 * vec2(ivec2(2u * pixel) - ivec2(frame.width, frame.height)) + place;
    return normalize(frame.camera_forward + from_centre.x * frame.camera_right - from_centre.y * frame.camera_up);
}

#endif
