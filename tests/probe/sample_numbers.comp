// Takes a block of a sample's numbers with the shipped sampler: one block per invocation, pixel by pixel.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "sampler.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push {
    uvec2 seed;
    uint first_pixel;
    uint pixel_count;
    uint first_sample;
    uint sample_count;
    uint first_dimension;
    uint dimension_count;
};
layout(set = 0, binding = 2) writeonly buffer Output { vec4 numbers[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= pixel_count * sample_count)
        return;
    uint row = index % sample_count;
    SampleKey key = SampleKey(seed, first_pixel + index / sample_count, first_sample + row, row * TABLE_DIMENSIONS);
    numbers[index] = sample_block(key, first_dimension, dimension_count);
}
