// The camera ray of a sample: where its path begins, and what coverage.comp counts. With LENS it starts on a thin lens.
#ifndef CAMERA_RAY_GLSL
#define CAMERA_RAY_GLSL

#include "camera.glsl"
#include "dimensions.glsl"
#include "sampling.glsl"

// The ray of ray_through(), through a point of the unit disc that is the lens, right and downwards: all rays of a place
// in the image meet on the plane in focus. With F the length of forward and f how far the plane is from the lens, the
// pinhole's ray is there at f / F times its place in the image, and the ray that starts a beside it leads there if its
// place changes by -a F / f. lens_blur is F / f times the lens's radius, lens_radius what is left of that ahead of the
// lens.
CameraRay ray_through_lens(CameraView camera, uvec2 pixel, vec3 numbers, vec2 disc)
{
    vec2 from_middle = image_place(camera, pixel, numbers.xy);
    vec2 start = camera.start_scale * from_middle + camera.lens_radius * disc;
    vec3 origin = start.x * camera.right - start.y * camera.up;
    return CameraRay(origin, camera_direction(camera, from_middle - camera.lens_blur * disc), numbers.z);
}

// Samples are spread evenly over the square of the pixel (box filter).
CameraRay camera_ray(CameraView camera, uvec2 pixel, SampleKey key)
{
    if (LENS == 1)
        return ray_through_lens(camera, pixel, camera_numbers(key), concentric_disc(sample_block(key, 1u).xy));
    return ray_through(camera, pixel, camera_numbers(key));
}

#endif
