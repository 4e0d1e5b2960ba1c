// Evaluates the shipped camera_direction.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "camera.glsl"

#include "items.glsl"

struct Item { vec4 right_width; vec4 up_height; vec4 forward; vec4 pixel_place; };
layout(set = 0, binding = 2) writeonly buffer Output { vec4 results[]; };
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
    vec2 place = image_place(camera, floatBitsToUint(item.pixel_place.xy), item.pixel_place.zw);
    results[index] = vec4(camera_direction(camera, place), 0.0);
}
