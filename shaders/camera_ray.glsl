#ifndef CAMERA_RAY_GLSL
#define CAMERA_RAY_GLSL

#include "camera.glsl"
#include "dimensions.glsl"
#include "sampling.glsl"

// All rays of an image place intersect in the plane of focus (shaders/README.md, section 2). disc is a point of the
// unit disc, right and down.
CameraRay ray_through_lens(CameraView camera, uvec2 pixel, vec3 numbers, vec2 disc)
{
    vec2 from_middle = image_place(camera, pixel, numbers.xy);
    vec2 start = camera.start_scale * from_middle + camera.lens_radius * disc;
    vec3 origin = start.x * camera.right - start.y * camera.up;
    return CameraRay(origin, camera_direction(camera, from_middle - camera.lens_blur * disc), numbers.z);
}

CameraRay camera_ray(CameraView camera, uvec2 pixel, SampleKey key)
{
    if (LENS == 1)
        return ray_through_lens(camera, pixel, camera_numbers(key), concentric_disc(sample_block(key, 1u).xy));
    return ray_through(camera, pixel, camera_numbers(key));
}

#endif
