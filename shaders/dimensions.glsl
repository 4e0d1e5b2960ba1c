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

// Where the blocks of a branch begin at its first vertex, and at a later one, the first being number 1.
uint first_vertex_blocks()
{
    return shared_blocks(LAMP_COUNT);
}

uint later_vertex_blocks(uint vertex)
{
    return first_vertex_blocks() + vertex_blocks(1u, LAMP_COUNT) + (vertex - 2u) * vertex_blocks(2u, LAMP_COUNT);
}

// Of blocks of a branch that begin at a place: the place on the lamp (x, y) and the choice among the lamps (z).
vec3 chosen_lamp_numbers(SampleKey branch, uint begin)
{
    return sample_block(branch, begin).xyz;
}

// Of as many blocks of a branch, the last one: direction (x, y), lobe (z) and survival (w).
vec4 direction_numbers(SampleKey branch, uint begin, uint count)
{
    vec4 numbers = sample_block(branch, begin + count - 1u);
    return GLOSS == 1u ? numbers : numbers.xyzz;
}

#endif
