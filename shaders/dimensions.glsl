// Maps each use of random numbers to a block of the sample, in the order of gpu_layout.h.
#ifndef DIMENSIONS_GLSL
#define DIMENSIONS_GLSL

#include "sampler.glsl"

const bool ROULETTE = MAX_PATH_LENGTH >= ROULETTE_MIN_LENGTH;

// Numbers for the place in the pixel (x, y) and the time (z).
vec3 camera_numbers(SampleKey key)
{
    return sample_block(key, 0u).xyz;
}

vec2 every_lamp_numbers(SampleKey key, uint lamp)
{
    return sample_block(key, CAMERA_BLOCKS + lamp).xy;
}

// Numbers for the direction (x, y) and the choice of the spot (z).
vec3 spot_numbers(SampleKey key)
{
    return sample_block(key, every_lamp_blocks(CAMERA_BLOCKS, LAMP_COUNT)).xyz;
}

uint blocks_at_spot()
{
    return every_lamp_blocks(CAMERA_BLOCKS, LAMP_COUNT) + 1u;
}

uint first_vertex_blocks()
{
    return blocks_of_sample();
}

uint later_vertex_blocks(uint vertex)
{
    return first_vertex_blocks() + vertex_blocks(1u, LAMP_COUNT) + (vertex - 2u) * vertex_blocks(2u, LAMP_COUNT);
}

struct ChosenLampNumbers {
    vec2 place;
    uint which;
};

ChosenLampNumbers chosen_lamp_numbers(SampleKey branch, uint begin)
{
    uvec4 words = traced_words(sample_words(branch, begin));
    return ChosenLampNumbers(vec2(words.xy >> 8u) * NUMBER_STEP, words.z);
}

// Numbers for the direction (x, y), the lobe (z) and the survival (w).
vec4 direction_numbers(SampleKey branch, uint begin, uint count)
{
    vec4 numbers = sample_block(branch, begin + count - 1u);
    return GLOSS == 1u ? numbers : numbers.xyzz;
}

// Returns the number that decides which surfaces a vertex's ray passes (shaders/README.md, section 8). Vertex 0 is the
// camera. Each branch has its own lattice, because only one has the shadow ray to a lamp.
uint opacity_number(SampleKey branch, uint vertex)
{
    const uint first_block = 1u << 31; // above the blocks of all paths
    const uint branches = vertex == 0u ? 1u : BRANCH_COUNT;
    uint block = first_block + vertex * BRANCH_COUNT + branch.sample_index % branches;
    if (SAMPLER == SAMPLER_RANDOM)
        return sample_words(branch, block).x;
    uint sample_index = branch.sample_index / branches;
    uint number = (bitfieldReverse(sample_index) + branch.shift.w + branch.seed.y) * odd_number(block);
    // The low bits choose a lattice of opacities. They stay the same for 16 samples of a pixel.
    return number ^ (number >> 16u & TREE_OPACITY_BITS);
}

#endif
