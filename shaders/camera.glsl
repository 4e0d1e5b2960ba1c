// Pinhole camera that looks from the origin, or from behind it; or one of parallel rays (ORTHOGRAPHIC).
#ifndef CAMERA_GLSL
#define CAMERA_GLSL

#include "gpu_layout.h"
#include "scene.glsl"

struct CameraRay {
    vec3 origin;
    vec3 direction;
    float time; // from 0 (shutter opens) to 1 (shutter closes)
};

// How far a place in [0, 1)^2 of the pixel (column, row), counted from the top left, lies from the image's middle: in
// pixels to the right and downwards. The pixel's part of it is a multiple of 1/2 and exact, however wide the image is.
vec2 image_place(FrameConstants frame, uvec2 pixel, vec2 place)
{
    return 0.5 * vec2(ivec2(2u * pixel) - ivec2(frame.width, frame.height)) + place;
}

// Unit direction through that place of the image.
vec3 camera_direction(FrameConstants frame, vec2 from_middle)
{
    if (ORTHOGRAPHIC == 1)
        return frame.camera_forward;
    return normalize(frame.camera_forward + from_middle.x * frame.camera_right - from_middle.y * frame.camera_up);
}

// Where the ray through that place starts: at the pinhole, or (STARTS_AHEAD) where it passes the plane through the
// origin across the view. Before that plane there is nothing in view, or only what parallel rays do not see
// (lib/kernel/ray_start.h).
vec3 camera_origin(FrameConstants frame, vec2 from_middle)
{
    if (STARTS_AHEAD == 0)
        return vec3(0.0);
    vec2 start = frame.start_scale * from_middle;
    return start.x * frame.camera_right - start.y * frame.camera_up;
}

#endif
