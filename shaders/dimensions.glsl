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

// First dimension of a vertex, 1 being the first.
uint vertex_dimension(uint vertex)
{
    uint stride = lamp_dimensions(LAMP_COUNT) + direction_dimensions(GLOSS, MAX_PATH_LENGTH);
    return camera_dimensions(MOTION) + (vertex - 1u) * stride;
}

// Place on a given lamp at a vertex, where every lamp is sampled.
vec2 every_lamp_numbers(SampleKey key, uint vertex, uint lamp)
{
    return sample_block(key, vertex_dimension(vertex) + 2u * lamp, 2u).xy;
}

// Place on the lamp (x, y) and choice among the lamps (z) at a vertex.
vec3 chosen_lamp_numbers(SampleKey key, uint vertex)
{
    return sample_block(key, vertex_dimension(vertex), 3u).xyz;
}

// Direction (x, y), lobe (z) and survival (w) at a vertex.
vec4 direction_numbers(SampleKey key, uint vertex)
{
    uint count = direction_dimensions(GLOSS, MAX_PATH_LENGTH);
    vec4 numbers = sample_block(key, vertex_dimension(vertex) + lamp_dimensions(LAMP_COUNT), count);
    return GLOSS == 1u ? numbers : numbers.xyzz;
}

#endif
