// Where the numbers that a path consumes are among the blocks of its sample. gpu_layout.h defines their order.
#ifndef DIMENSIONS_GLSL
#define DIMENSIONS_GLSL

#include "sampler.glsl"

const bool ROULETTE = MAX_PATH_LENGTH >= ROULETTE_MIN_LENGTH;

// The place within the pixel (x, y) and the time (z).
vec3 camera_numbers(SampleKey key)
{
    return sample_block(key, 0u).xyz;
}

// A place on a lamp, at the first vertex if that samples every lamp.
vec2 every_lamp_numbers(SampleKey key, uint lamp)
{
    return sample_block(key, CAMERA_BLOCKS + lamp).xy;
}

// For the ray towards a spot: the direction around it (x, y), and which spot (z).
vec3 spot_numbers(SampleKey key)
{
    return sample_block(key, every_lamp_blocks(CAMERA_BLOCKS, LAMP_COUNT)).xyz;
}

// The first block of the vertex at a spot, whose blocks are like those of a later vertex.
uint blocks_at_spot()
{
    return every_lamp_blocks(CAMERA_BLOCKS, LAMP_COUNT) + 1u;
}

// The first block of a branch at its first vertex, which is number 1, and at later ones.
uint first_vertex_blocks()
{
    return blocks_of_sample();
}

uint later_vertex_blocks(uint vertex)
{
    return first_vertex_blocks() + vertex_blocks(1u, LAMP_COUNT) + (vertex - 2u) * vertex_blocks(2u, LAMP_COUNT);
}

// From the blocks of a vertex that begin at begin: a place on the chosen lamp, and the choice of the lamp, by all 32
// bits of a number.
struct ChosenLampNumbers {
    vec2 place;
    uint which;
};

ChosenLampNumbers chosen_lamp_numbers(SampleKey branch, uint begin)
{
    uvec4 words = sample_words(branch, begin);
    return ChosenLampNumbers(vec2(words.xy >> 8u) * NUMBER_STEP, words.z);
}

// From the last of the count blocks of a vertex: the direction (x, y), the choice between lobe and cosine (z), and
// survival (w).
vec4 direction_numbers(SampleKey branch, uint begin, uint count)
{
    vec4 numbers = sample_block(branch, begin + count - 1u);
    return GLOSS == 1u ? numbers : numbers.xyzz;
}

#endif
