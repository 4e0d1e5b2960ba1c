#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "intersect.glsl"

#include "items.glsl"

// start: 0 anywhere, 1 on the sphere and outside, 2 inside. For planes, center is the normal and radius the height.
struct Item { vec4 center_radius; vec4 direction_start; };
layout(set = 0, binding = 2) writeonly buffer Output { vec4 results[]; };
layout(set = 0, binding = 3) readonly buffer Input { Item items[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (!is_item(index))
        return;
    vec4 sphere = items[index].center_radius;
    vec3 direction = items[index].direction_start.xyz;
    float start = items[index].direction_start.w;
    bool leaving = start > 0.0;
    bool outside = dot(sphere.xyz, sphere.xyz) > sphere.w * sphere.w;
    float distance = sphere_distance(sphere.xyz, sphere.w, direction, leaving, start == 2.0, outside);
    float beyond = distance < NO_HIT ? 1.1 * distance : NO_HIT;
    results[index] = vec4(distance, plane_distance(Level(sphere.w, sphere.xyz, 0.0), direction, leaving, start == 2.0, sphere.w),
                          sphere_blocks(sphere.xyz, sphere.w, direction, leaving, 0.9 * beyond / 1.1) ? 1.0 : 0.0,
                          sphere_blocks(sphere.xyz, sphere.w, direction, leaving, beyond) ? 1.0 : 0.0);
}
