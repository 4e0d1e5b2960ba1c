#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "lights.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { vec4 position; vec4 normal_time; uint count; };
layout(set = 0, binding = 2) writeonly buffer Output { float probabilities[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= count)
        return;
    vec3 normal = normal_time.xyz;
    Lamps lamps = lamps_from(Vertex(position.xyz, normal, normal, NO_SURFACE, false), normal_time.w);
    probabilities[index] = choice_of(lamps, index).probability;
}
