// Where each number that a path consumes lies among the sample's blocks; gpu_layout.h has the order. Used by path.glsl.
#ifndef DIMENSIONS_GLSL
#define DIMENSIONS_GLSL

#include "sampler.glsl"

const bool ROULETTE = MAX_PATH_LENGTH >= ROULETTE_MIN_LENGTH;

// Place in the pixel (x, y) and time (z).
vec3 camera_numbers(SampleKey key)
{
    return sample_block(key, 0u).xyz;
}

// Place on a lamp at the first vertex, where every lamp is sampled.
vec2 every_lamp_numbers(SampleKey key, uint lamp)
{
    return sample_block(key, 1u + lamp).xy;
}

// First block of a branch at a vertex, 1 being the first.
uint first_block(uint vertex)
{
    const uint first = shared_blocks(LAMP_COUNT);
    const uint second = first + vertex_blocks(1u, LAMP_COUNT);
    return vertex == 1u ? first : second + (vertex - 2u) * vertex_blocks(2u, LAMP_COUNT);
}

// Place on the lamp (x, y) and choice among the lamps (z) at a vertex.
vec3 chosen_lamp_numbers(SampleKey branch, uint vertex)
{
    return sample_block(branch, first_block(vertex)).xyz;
}

// Direction (x, y), lobe (z) and survival (w) at a vertex: its last block.
vec4 direction_numbers(SampleKey branch, uint vertex)
{
    vec4 numbers = sample_block(branch, first_block(vertex) + vertex_blocks(vertex, LAMP_COUNT) - 1u);
    return GLOSS == 1u ? numbers : numbers.xyzz;
}

#endif
