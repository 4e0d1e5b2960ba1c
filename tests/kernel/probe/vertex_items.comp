#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "vertex.glsl"

#include "items.glsl"

struct Item { vec4 origin_surface; vec4 direction_distance; };
struct Result { vec4 position; vec4 normal; vec4 mirror; };
layout(set = 0, binding = 2) writeonly buffer Output { Result results[]; };
layout(set = 0, binding = 3) readonly buffer Input { Item items[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (!is_item(index))
        return;
    Item item = items[index];
    vec3 direction = item.direction_distance.xyz;
    vec3 point = item.origin_surface.xyz + item.direction_distance.w * direction;
    Vertex vertex = vertex_at(Arrival(point, direction, floatBitsToUint(item.origin_surface.w)), 0.0);
    results[index] = Result(vec4(vertex.position, vertex.inside ? 1.0 : 0.0), vec4(vertex.normal, 0.0),
                            vec4(vertex.mirror, 0.0));
}
