// Where each number that a path consumes lies among the sample's dimensions; gpu_layout.h has the order. Used by
// path.glsl.
#ifndef DIMENSIONS_GLSL
#define DIMENSIONS_GLSL

#include "sampler.glsl"

const bool ROULETTE = MAX_PATH_LENGTH >= ROULETTE_MIN_LENGTH;

// Place in the pixel (x, y) and time (z).
vec3 camera_numbers(SampleKey key)
{
    return sample_block(key, 0u, camera_dimensions(MOTION)).xyz;
}

// Place on a lamp at the first vertex, where every lamp is sampled.
vec2 every_lamp_numbers(SampleKey key, uint lamp)
{
    return sample_block(key, camera_dimensions(MOTION) + 2u * lamp, 2u).xy;
}

// First dimension of a branch at a vertex, 1 being the first.
uint vertex_dimension(uint vertex)
{
    uint direction = direction_dimensions(GLOSS, MAX_PATH_LENGTH);
    uint first = shared_dimensions(MOTION, LAMP_COUNT);
    uint second = first + chosen_lamp_dimensions(1u, LAMP_COUNT) + direction;
    uint stride = chosen_lamp_dimensions(2u, LAMP_COUNT) + direction;
    return vertex == 1u ? first : second + (vertex - 2u) * stride;
}

// Place on the lamp (x, y) and choice among the lamps (z) at a vertex.
vec3 chosen_lamp_numbers(SampleKey branch, uint vertex)
{
    return sample_block(branch, vertex_dimension(vertex), chosen_lamp_dimensions(vertex, LAMP_COUNT)).xyz;
}

// Direction (x, y), lobe (z) and survival (w) at a vertex.
vec4 direction_numbers(SampleKey branch, uint vertex)
{
    uint first = vertex_dimension(vertex) + chosen_lamp_dimensions(vertex, LAMP_COUNT);
    vec4 numbers = sample_block(branch, first, direction_dimensions(GLOSS, MAX_PATH_LENGTH));
    return GLOSS == 1u ? numbers : numbers.xyzz;
}

#endif
