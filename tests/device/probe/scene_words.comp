// Reads every word of the scene with the shipped functions: by its index, and among those from one on.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "scene.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { uint count; uint first; };

struct Read { vec4 word; vec4 among; };
layout(set = 0, binding = 2) writeonly buffer Output { Read reads[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= count)
        return;
    reads[index] = Read(scene_word(index), scene_word_among(first, count - first, max(index, first) - first));
}
