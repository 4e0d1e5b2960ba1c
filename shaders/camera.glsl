// The camera is at or behind the origin.
#ifndef CAMERA_GLSL
#define CAMERA_GLSL

#include "gpu_layout.h"
#include "scene.glsl"

struct CameraRay {
    vec3 origin;
    vec3 direction;
    float time; // [0, 1] from shutter open to closed
};

// Offset from the image's middle in pixels, right and down. place is in [0, 1)^2 within the pixel.
vec2 image_place(CameraView camera, uvec2 pixel, vec2 place)
{
    return 0.5 * vec2(ivec2(2u * pixel) - ivec2(camera.width, camera.height)) + place;
}

vec3 camera_direction(CameraView camera, vec2 from_middle)
{
    if (PROJECTION == PROJECTION_ORTHOGRAPHIC)
        return camera.forward;
    return normalize(camera.forward + from_middle.x * camera.right - from_middle.y * camera.up);
}

// Rays start at the pinhole. With STARTS_AHEAD they start on the plane through the origin perpendicular to the view. No
// surface in view is before this plane (lib/view/projection.h).
vec3 camera_origin(CameraView camera, vec2 from_middle)
{
    if (STARTS_AHEAD == 0)
        return vec3(0.0);
    vec2 start = camera.start_scale * from_middle;
    return start.x * camera.right - start.y * camera.up;
}

CameraRay ray_through(CameraView camera, uvec2 pixel, vec3 numbers)
{
    vec2 from_middle = image_place(camera, pixel, numbers.xy);
    return CameraRay(camera_origin(camera, from_middle), camera_direction(camera, from_middle), numbers.z);
}

// All rays of an image place intersect in the plane of focus (shaders/README.md, section 2). disc is a point of the
// unit disc, right and down.
CameraRay ray_through_lens(CameraView camera, uvec2 pixel, vec3 numbers, vec2 disc)
{
    vec2 from_middle = image_place(camera, pixel, numbers.xy);
    vec2 start = camera.start_scale * from_middle + camera.lens_radius * disc;
    vec3 origin = start.x * camera.right - start.y * camera.up;
    return CameraRay(origin, camera_direction(camera, from_middle - camera.lens_blur * disc), numbers.z);
}

#endif
