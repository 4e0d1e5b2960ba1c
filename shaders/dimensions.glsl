// Which block of a sample has which numbers (order: gpu_layout.h).
#ifndef DIMENSIONS_GLSL
#define DIMENSIONS_GLSL

#include "sampler.glsl"

const bool ROULETTE = MAX_PATH_LENGTH >= ROULETTE_MIN_LENGTH;

// Place in the pixel; time.
vec3 camera_numbers(SampleKey key)
{
    return sample_block(key, 0u).xyz;
}

// Place on a lamp, where the first vertex samples every lamp.
vec2 every_lamp_numbers(SampleKey key, uint lamp)
{
    return sample_block(key, CAMERA_BLOCKS + lamp).xy;
}

// Direction; which spot.
vec3 spot_numbers(SampleKey key)
{
    return sample_block(key, every_lamp_blocks(CAMERA_BLOCKS, LAMP_COUNT)).xyz;
}

// First block of the vertex at a spot, like a later vertex's.
uint blocks_at_spot()
{
    return every_lamp_blocks(CAMERA_BLOCKS, LAMP_COUNT) + 1u;
}

// First block of a branch.
uint first_vertex_blocks()
{
    return blocks_of_sample();
}

uint later_vertex_blocks(uint vertex)
{
    return first_vertex_blocks() + vertex_blocks(1u, LAMP_COUNT) + (vertex - 2u) * vertex_blocks(2u, LAMP_COUNT);
}

// `which` has all 32 bits.
struct ChosenLampNumbers {
    vec2 place;
    uint which;
};

ChosenLampNumbers chosen_lamp_numbers(SampleKey branch, uint begin)
{
    uvec4 words = sample_words(branch, begin);
    return ChosenLampNumbers(vec2(words.xy >> 8u) * NUMBER_STEP, words.z);
}

// Direction (x, y), lobe (z), survival (w), in a vertex's last block.
vec4 direction_numbers(SampleKey branch, uint begin, uint count)
{
    vec4 numbers = sample_block(branch, begin + count - 1u);
    return GLOSS == 1u ? numbers : numbers.xyzz;
}

// Decides whether a vertex's ray passes a surface (passes() of tree_walk.glsl); vertex 0 is the camera. Times a
// surface's odd number it is a coordinate of a lattice: each 16 samples fall into different ones of 16 parts of [0, 1).
// Some lattices spread the decisions of two surfaces badly, so pixels, and each 16 samples, have different ones: the
// last bits choose them.
uint opacity_number(SampleKey branch, uint vertex)
{
    const uint first_block = 1u << 31; // beyond all paths' blocks
    uint block = first_block + vertex;
    if (SAMPLER == SAMPLER_RANDOM)
        return sample_words(branch, block).x;
    uint number = (bitfieldReverse(branch.sample_index) + branch.shift.w + branch.seed.y) * odd_number(block);
    return number ^ (number >> 16u & TREE_OPACITY_BITS); // bits without the index's last four
}

#endif
