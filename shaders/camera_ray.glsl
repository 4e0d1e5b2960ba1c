// The camera ray of a sample: where its path begins, and what coverage.comp counts.
#ifndef CAMERA_RAY_GLSL
#define CAMERA_RAY_GLSL

#include "camera.glsl"
#include "dimensions.glsl"

// Samples are spread evenly over the square of the pixel (box filter).
CameraRay camera_ray(CameraView camera, uvec2 pixel, SampleKey key)
{
    return ray_through(camera, pixel, camera_numbers(key));
}

#endif
