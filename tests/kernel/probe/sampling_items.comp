#version 450
#extension GL_GOOGLE_include_directive : require

#include "gpu_layout.h"
#include "sampling.glsl"

#include "items.glsl"

struct Item { vec4 axis_height; vec4 numbers_densities; };
struct Result { vec4 about; vec4 cosine; vec4 hemisphere; vec4 weight; };
layout(set = 0, binding = 2) writeonly buffer Output { Result results[]; };
layout(set = 0, binding = 3) readonly buffer Input { Item items[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (!is_item(index))
        return;
    vec3 axis = items[index].axis_height.xyz;
    vec4 numbers = items[index].numbers_densities;
    results[index] = Result(vec4(direction_about(axis, narrow_cos_sin(items[index].axis_height.w), numbers.y), 0.0),
                            vec4(direction_about(axis, cosine_hemisphere_cos_sin(numbers.x), numbers.y), 0.0),
                            vec4(uniform_hemisphere_direction(axis, numbers.xy), 0.0),
                            vec4(power_heuristic(numbers.z, numbers.w), 0.0, concentric_disc(numbers.xy)));
}
