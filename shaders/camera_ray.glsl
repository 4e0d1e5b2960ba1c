// The camera ray of a sample: where its path begins, and what coverage.comp counts.
#ifndef CAMERA_RAY_GLSL
#define CAMERA_RAY_GLSL

#include "camera.glsl"
#include "dimensions.glsl"

// Spread over the pixel's square (box filter).
CameraRay camera_ray(FrameConstants frame, uvec2 pixel, SampleKey key)
{
    vec3 numbers = camera_numbers(key);
    vec2 from_middle = image_place(frame, pixel, numbers.xy);
    return CameraRay(camera_origin(frame, from_middle), camera_direction(frame, from_middle), numbers.z);
}

#endif
