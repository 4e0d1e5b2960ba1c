// The numbers in [0, 1) that a sample is made of, as a pure function of (seed, pixel, sample, dimension), so that a
// sample's value depends on nothing else. gpu_layout.h says who owns which dimension. Used by dimensions.glsl.
#ifndef SAMPLER_GLSL
#define SAMPLER_GLSL

#include "scene.glsl"

// A row holds the points of a sample: coordinates as multiples of 2^-32, those of Sobol with their bits
// reversed; gpu_layout.h has their order. The points are the same in every pixel; what differs is made from them below.
layout(set = 0, binding = BINDING_POINTS) readonly buffer Points { uint words[]; } points;

struct SampleKey {
    uvec2 seed;
    uint pixel; // index in the image, row by row
    uint sample_index;
    uint table_word; // where dimension 0 is, or would be, in the point table
};

// The key of a branch of a sample: in the dimensions beyond the shared ones it is a sample of its own, number B i + b.
// Where that passes 2^32 the seed changes, and the table goes on with Halton's points, so that no branch repeats
// another's numbers.
SampleKey branch_key(SampleKey key, uint branch)
{
    uint high, low;
    umulExtended(key.sample_index, BRANCH_COUNT, high, low);
    uint branch_words = TABLE_DIMENSIONS - shared_dimensions(MOTION, LAMP_COUNT);
    return SampleKey(key.seed + uvec2(0u, high), key.pixel, low + branch, key.table_word + branch * branch_words);
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

// Owen scrambling in base 2 of a coordinate given with its bits reversed: each bit is flipped or not by a hash of the
// bits above it (Owen 1995; as a hash, Laine and Karras 2011; Burley, "Practical Hash-based Owen Scrambling", JCGT
// 9(4), 2020). In reversed order "above" means "less significant", which carries of sums and products respect. The
// constants are those of N. Vegdahl's search for a hash with better avalanche (2021).
uvec4 owen_scrambled(uvec4 reversed, uvec4 seed)
{
    uvec4 v = reversed;
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16u) | 1u;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return bitfieldReverse(v);
}

const float NUMBER_STEP = 1.0 / 16777216.0;
const float LARGEST_NUMBER = 1.0 - NUMBER_STEP;

// The sample's numbers for count (at most 4) dimensions from first on, one owner's block. Multiples of 2^-24, so that
// rounding never gives 1. A dimension beyond the table takes hashed random numbers, whatever the sampler.
vec4 sample_block(SampleKey key, uint first, uint count)
{
    bool in_table = SAMPLER != SAMPLER_RANDOM && first + count <= TABLE_DIMENSIONS;
    // One hash serves both: per pixel and dimension the scrambling, per sample as well the random numbers.
    uvec4 hash = pcg4d(uvec4(key.pixel, in_table ? 0u : key.sample_index, first + key.seed.x, key.seed.y));
    uvec4 words = hash;
    if (SAMPLER != SAMPLER_RANDOM) {
        uint row = in_table ? key.table_word + first : 0u;
        uvec4 point = uvec4(points.words[row], points.words[row + 1u], points.words[row + 2u], points.words[row + 3u]);
        if (SAMPLER == SAMPLER_SOBOL)
            point = owen_scrambled(point, hash ^ (hash >> 16u)); // whose low bits, the first digits, pcg4d mixes least
        else if (SAMPLER == SAMPLER_HALTON_CP)
            point += hash; // Cranley and Patterson 1976: a rotation, addition modulo 1
        words = in_table ? point : hash;
    }
    return vec4(words >> 8u) * NUMBER_STEP;
}

#endif
