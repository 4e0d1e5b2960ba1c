// Faulty on purpose: skips value 100, and writes an additional value for the argument 2.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "gpu_layout.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { uint arguments_per_function; };
layout(set = 0, binding = 0) readonly buffer Arguments { float arguments[]; };
layout(set = 0, binding = 1) writeonly buffer Values { float values[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index != 100u)
        values[index + (arguments[index] == 2.0 ? 1u : 0u)] = arguments[index];
}
