// Offers branches of given worths to the shipped reservoir, with a number per invocation, spread evenly.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "last_direction.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { vec4 worths; uint count; };

struct Kept {
    uint branch;
    float worth;
    float total_worth;
    float number; // what is left of it
};

layout(set = 0, binding = 2) writeonly buffer Output { Kept kept[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= count)
        return;
    Arrival nowhere = Arrival(vec3(0.0), vec3(0.0), NO_SURFACE);
    Reservoir reservoir = empty_reservoir(nowhere, (float(index) + 0.5) / float(count));
    [[unroll]] for (uint branch = 0u; branch < 4u; ++branch) {
        Path path = path_from(nowhere);
        path.arrival.surface = branch;
        path.throughput = vec3(float(branch));
        offer(reservoir, path, worths[branch]);
    }
    bool is_one = reservoir.throughput == vec3(float(reservoir.arrival.surface));
    kept[index] = Kept(is_one ? reservoir.arrival.surface : NO_SURFACE, reservoir.worth, reservoir.total_worth,
                       reservoir.number);
}
