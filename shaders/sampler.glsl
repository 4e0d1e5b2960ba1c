// A sample's random numbers in [0, 1): a pure function of seed, pixel, sample and dimension (shaders/README.md, section
// 8).
#ifndef SAMPLER_GLSL
#define SAMPLER_GLSL

#include "maths.glsl"
#include "scene.glsl"
#include "trace.glsl"

// The sequence's points in units of 2^-32. Each sample has a row of blocks. All invocations read the same block at a
// time, so the buffer is uniform.
layout(set = 0, binding = BINDING_POINTS) uniform Points { uvec4 blocks[POINT_BLOCKS]; } points;

struct SampleKey {
    uvec2 seed;
    uint pixel; // index in the image, row by row
    uint sample_index;
    uint row;    // index of block 0 in `points`
    uvec4 shift; // hash of the pixel
};

uint blocks_of_sample() { return shared_blocks(CAMERA_BLOCKS, LAMP_COUNT, SPOT_COUNT); }

// Branch b of B in sample i has the blocks of the sample with index B i + b. If this index exceeds 2^32, the seed
// changes, so that numbers do not repeat.
SampleKey branch_key(SampleKey key, uint branch)
{
    uint high, low;
    umulExtended(key.sample_index, BRANCH_COUNT, high, low);
    uint branch_blocks = TABLE_BLOCKS - blocks_of_sample();
    return SampleKey(key.seed + uvec2(0u, high), key.pixel, low + branch, key.row + branch * branch_blocks, key.shift);
}

// The hash pcg4d of Jarzynski and Olano 2020.
uvec4 pcg4d(uvec4 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

SampleKey key_of_pixel(uvec2 seed, uint pixel)
{
    return SampleKey(seed, pixel, 0u, 0u, pcg4d(uvec4(pixel, 0u, seed)));
}

// Returns the block's odd number, which shift_of() multiplies with the pixel's hash (shaders/README.md, section 8).
uint odd_number(uint block)
{
    uint odd = block * 0x9e3779b9u + 0xc2b2ae35u;
    return ((odd ^ odd >> 16u) * 0x7feb352du) | 1u;
}

uvec4 shift_of(SampleKey key, uint block) { return key.shift * odd_number(block); }

bool all_in_table()
{
    return path_blocks(MAX_PATH_LENGTH, CAMERA_BLOCKS, LAMP_COUNT, SPOT_COUNT) <= TABLE_BLOCKS;
}

// Returns numbers in units of 2^-32. XOR with shift_of() turns the table's Owen scrambling into another one.
// Halton points are rotated modulo 1 (Cranley and Patterson 1976).
uvec4 sample_words(SampleKey key, uint block)
{
    bool in_table = SAMPLER != SAMPLER_RANDOM && (all_in_table() || block < TABLE_BLOCKS);
    if (!in_table)
        return pcg4d(uvec4(key.pixel, key.sample_index, block + key.seed.x, key.seed.y));
    uvec4 point = points.blocks[key.row + block];
    uvec4 shift = shift_of(key, block);
    return SAMPLER == SAMPLER_SOBOL ? point ^ shift : SAMPLER == SAMPLER_HALTON_CP ? point + shift : point;
}

// Returns multiples of 2^-24 below 1. A conversion of all 32 bits could round to 1.
vec4 sample_block(SampleKey key, uint block)
{
    return vec4(traced_words(sample_words(key, block)) >> 8u) * NUMBER_STEP;
}

#endif
