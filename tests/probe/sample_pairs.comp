// Index of the sample that each half of the film has of consecutive pairs, with the shipped function.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "film.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { uint first_pair; uint count; uint mask; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    film.words[2u * i] = sample_of_pair(first_pair + i, 0u, mask);
    film.words[2u * i + 1u] = sample_of_pair(first_pair + i, 1u, mask);
}
