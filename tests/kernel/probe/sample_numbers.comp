#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "sampler.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push {
    uvec2 seed;
    uint first_pixel;
    uint pixel_count;
    uint first_sample;
    uint sample_count;
    uint block;
    uint branch;
};
layout(set = 0, binding = 2) writeonly buffer Output { vec4 numbers[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= pixel_count * sample_count)
        return;
    uint row = index % sample_count;
    uint row_length = row_blocks(TABLE_BLOCKS, blocks_of_sample(), BRANCH_COUNT);
    SampleKey key = key_of_pixel(seed, first_pixel + index / sample_count);
    key.sample_index = first_sample + row;
    key.row = row * row_length;
    numbers[index] = sample_block(branch_key(key, branch), block);
}
