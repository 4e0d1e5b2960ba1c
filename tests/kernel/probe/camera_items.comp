#version 450
#extension GL_GOOGLE_include_directive : require

#include "camera.glsl"

#include "items.glsl"

struct Item { vec4 right_width; vec4 up_height; vec4 forward; vec4 pixel_place; vec4 lens; };
struct Result { vec4 direction; vec4 lens_origin; vec4 lens_direction; };
layout(set = 0, binding = 2) writeonly buffer Output { Result results[]; };
layout(set = 0, binding = 3) readonly buffer Input { Item items[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (!is_item(index))
        return;
    Item item = items[index];
    CameraView camera;
    camera.right = item.right_width.xyz;
    camera.up = item.up_height.xyz;
    camera.forward = item.forward.xyz;
    camera.width = floatBitsToUint(item.right_width.w);
    camera.height = floatBitsToUint(item.up_height.w);
    camera.start_scale = 0.0;
    camera.lens_radius = item.lens.x;
    camera.lens_blur = item.lens.y;
    vec2 place = image_place(camera, floatBitsToUint(item.pixel_place.xy), item.pixel_place.zw);
    CameraRay ray = ray_through_lens(camera, floatBitsToUint(item.pixel_place.xy), vec3(item.pixel_place.zw, 0.0), item.lens.zw);
    results[index] =
        Result(vec4(camera_direction(camera, place), 0.0), vec4(ray.origin, 0.0), vec4(ray.direction, 0.0));
}
