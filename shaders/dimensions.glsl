// Where each number that a path consumes lies among the sample's blocks; gpu_layout.h has the order.
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

// For the way by a spot: place about it (x, y) and which spot (z).
vec3 spot_numbers(SampleKey key)
{
    return sample_block(key, every_lamp_blocks(LAMP_COUNT)).xyz;
}

// Where the blocks of the vertex at the spot begin, which are like a later vertex's.
uint blocks_at_spot()
{
    return every_lamp_blocks(LAMP_COUNT) + 1u;
}

// Where the blocks of a branch begin for its first vertex, which is number 1, and for a later one.
uint first_vertex_blocks()
{
    return blocks_of_sample();
}

uint later_vertex_blocks(uint vertex)
{
    return first_vertex_blocks() + vertex_blocks(1u, LAMP_COUNT) + (vertex - 2u) * vertex_blocks(2u, LAMP_COUNT);
}

// From the blocks of a vertex, which start at begin: place on the chosen lamp, and which lamp, by all 32 bits of a
// number.
struct ChosenLampNumbers {
    vec2 place;
    uint which;
};

ChosenLampNumbers chosen_lamp_numbers(SampleKey branch, uint begin)
{
    uvec4 words = sample_words(branch, begin);
    return ChosenLampNumbers(vec2(words.xy >> 8u) * NUMBER_STEP, words.z);
}

// From the last of the count blocks of a vertex: direction (x, y), lobe or cosine (z) and survival (w).
vec4 direction_numbers(SampleKey branch, uint begin, uint count)
{
    vec4 numbers = sample_block(branch, begin + count - 1u);
    return GLOSS == 1u ? numbers : numbers.xyzz;
}

#endif
