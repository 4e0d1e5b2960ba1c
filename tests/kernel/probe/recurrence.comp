#version 450

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint multiplier = 1u;
layout(constant_id = 1) const uint increment = 0u;
layout(push_constant) uniform Push { uint steps; };
layout(set = 0, binding = 0) uniform Offset { uvec4 offset; };
layout(set = 0, binding = 1) buffer Values { uint values[]; };

void main()
{
    uint x = values[gl_GlobalInvocationID.x] + offset.x;
    uint step = 0u;
    do {
        x = x * multiplier + increment;
        ++step;
    } while (step < steps);
    values[gl_GlobalInvocationID.x] = x;
}
