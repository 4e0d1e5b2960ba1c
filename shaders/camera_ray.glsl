// The camera ray of a sample: where its path begins, and what coverage.comp counts.
#ifndef CAMERA_RAY_GLSL
#define CAMERA_RAY_GLSL

#include "camera.glsl"
#include "dimensions.glsl"
#include "sampling.glsl"

// Samples are spread evenly over the square of the pixel (box filter).
CameraRay camera_ray(CameraView camera, uvec2 pixel, SampleKey key)
{
    if (LENS == 1)
        return ray_through_lens(camera, pixel, camera_numbers(key), concentric_disc(lens_numbers(key)));
    return ray_through(camera, pixel, camera_numbers(key));
}

#endif
