// The numbers in [0, 1) that a sample is made of, as a pure function of (seed, pixel, sample, dimension), so that a
// sample's value depends on nothing else. gpu_layout.h says who owns which dimension.
#ifndef SAMPLER_GLSL
#define SAMPLER_GLSL

#include "maths.glsl"
#include "scene.glsl"

// The points of the sequence, a row of blocks for each sample: coordinates as multiples of 2^-32, the same in every
// pixel. A uniform buffer, since all invocations read the same block at a time.
layout(set = 0, binding = BINDING_POINTS) uniform Points { uvec4 blocks[POINT_BLOCKS]; } points;

struct SampleKey {
    uvec2 seed;
    uint pixel; // index in the image, row by row
    uint sample_index;
    uint row;    // where block 0 is, or would be, in the point table
    uvec4 shift; // the pixel's; the shifts of its blocks are multiples of it
};

// The blocks that all branches of a sample share.
uint blocks_of_sample() { return shared_blocks(CAMERA_BLOCKS, LAMP_COUNT, SPOT_COUNT); }

// The key of a branch of a sample: beyond the shared blocks it is a sample of its own, number B i + b. Where that
// passes 2^32 the seed changes, and with it the table's points, so that no branch repeats another's numbers.
SampleKey branch_key(SampleKey key, uint branch)
{
    uint high, low;
    umulExtended(key.sample_index, BRANCH_COUNT, high, low);
    uint branch_blocks = TABLE_BLOCKS - blocks_of_sample();
    return SampleKey(key.seed + uvec2(0u, high), key.pixel, low + branch, key.row + branch * branch_blocks, key.shift);
}

// The hash pcg4d of Jarzynski and Olano, "Hash Functions for GPU Rendering" (JCGT 9(3), 2020): four random words of
// four words of input.
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

// The key of a pixel. An index and a row make it the key of a sample.
SampleKey key_of_pixel(uvec2 seed, uint pixel)
{
    return SampleKey(seed, pixel, 0u, 0u, pcg4d(uvec4(pixel, 0u, seed)));
}

// Each pixel shifts the points of the table, every block by another number: the pixel's hash times an odd number of the
// block. The product of a uniform word and an odd one is uniform, and several products of one word are points of a
// lattice (Korobov 1959), as good as independent in all digits that matter: with these constants chi-squares of 16^3
// cells are like those of independent words for any three of forty blocks. A hash of pixel and block would take three
// times as many multiplications, an eighth of the time on lavapipe with six vertices.
uvec4 shift_of(SampleKey key, uint block)
{
    uint odd = block * 0x9e3779b9u + 0xc2b2ae35u;
    odd = ((odd ^ odd >> 16u) * 0x7feb352du) | 1u;
    return key.shift * odd;
}

bool all_in_table()
{
    return path_blocks(MAX_PATH_LENGTH, CAMERA_BLOCKS, LAMP_COUNT, SPOT_COUNT) <= TABLE_BLOCKS;
}

// The sample's numbers of a block, as multiples of 2^-32. Sobol points are shifted digit by digit in base 2, by
// exclusive or: the table has them Owen-scrambled (Owen 1995), once for all pixels, and a shift turns one such
// scrambling into another. So each pixel has a scrambling of its own, and given the table the errors of pixels are
// independent. Halton points are rotated by addition modulo 1 (Cranley and Patterson 1976).
uvec4 sample_words(SampleKey key, uint block)
{
    bool in_table = SAMPLER != SAMPLER_RANDOM && (all_in_table() || block < TABLE_BLOCKS);
    if (!in_table)
        return pcg4d(uvec4(key.pixel, key.sample_index, block + key.seed.x, key.seed.y));
    uvec4 point = points.blocks[key.row + block];
    uvec4 shift = shift_of(key, block);
    return SAMPLER == SAMPLER_SOBOL ? point ^ shift : SAMPLER == SAMPLER_HALTON_CP ? point + shift : point;
}

// The same as multiples of 2^-24, so that rounding never yields 1.
vec4 sample_block(SampleKey key, uint block) { return vec4(sample_words(key, block) >> 8u) * NUMBER_STEP; }

#endif
