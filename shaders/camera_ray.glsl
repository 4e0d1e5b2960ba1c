// A sample's camera ray. With LENS it starts on a thin lens.
#ifndef CAMERA_RAY_GLSL
#define CAMERA_RAY_GLSL

#include "camera.glsl"
#include "dimensions.glsl"
#include "sampling.glsl"

// disc: point of the lens in the unit disc, right and down. All rays of an image place meet in the plane of focus: with
// F the length of forward and f the plane's distance, a ray that starts a beside the pinhole meets the pinhole's ray if
// its image place changes by -a F / f. lens_blur is F / f times the lens's radius; lens_radius is the part of it where
// rays start.
CameraRay ray_through_lens(CameraView camera, uvec2 pixel, vec3 numbers, vec2 disc)
{
    vec2 from_middle = image_place(camera, pixel, numbers.xy);
    vec2 start = camera.start_scale * from_middle + camera.lens_radius * disc;
    vec3 origin = start.x * camera.right - start.y * camera.up;
    return CameraRay(origin, camera_direction(camera, from_middle - camera.lens_blur * disc), numbers.z);
}

// Box filter.
CameraRay camera_ray(CameraView camera, uvec2 pixel, SampleKey key)
{
    if (LENS == 1)
        return ray_through_lens(camera, pixel, camera_numbers(key), concentric_disc(sample_block(key, 1u).xy));
    return ray_through(camera, pixel, camera_numbers(key));
}

#endif
