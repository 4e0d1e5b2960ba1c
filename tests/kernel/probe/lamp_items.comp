#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "lights.glsl"

#include "items.glsl"

struct Item { vec4 position_lamp; vec4 normal; vec4 numbers; };
struct Result { vec4 direction_distance; vec4 height_density_weight; };
layout(set = 0, binding = 2) writeonly buffer Output { Result results[]; };
layout(set = 0, binding = 3) readonly buffer Input { Item items[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (!is_item(index))
        return;
    Item item = items[index];
    vec3 normal = item.normal.xyz;
    uint lamp = floatBitsToUint(item.position_lamp.w);
    LampView view = view_lamp(Vertex(item.position_lamp.xyz, normal, normal, NO_SURFACE, false), lamp, 0.0);
    LampSample taken = sample_lamp(LampChoice(lamp, view, 1.0), item.numbers.xy);
    results[index] = Result(vec4(taken.shadow.direction, taken.shadow.distance),
                            vec4(one_minus_cos(view), taken.density, view.weight, 0.0));
}
