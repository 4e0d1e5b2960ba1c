// A path's numbers in the blocks of its sample; gpu_layout.h has the order.
#ifndef DIMENSIONS_GLSL
#define DIMENSIONS_GLSL

#include "sampler.glsl"

const bool ROULETTE = MAX_PATH_LENGTH >= ROULETTE_MIN_LENGTH;

// Place in the pixel (x, y) and time (z).
vec3 camera_numbers(SampleKey key)
{
    return sample_block(key, 0u).xyz;
}

// Place on a lamp, at the first vertex if it samples every lamp.
vec2 every_lamp_numbers(SampleKey key, uint lamp)
{
    return sample_block(key, CAMERA_BLOCKS + lamp).xy;
}

// Direction around a spot (x, y), and which spot (z).
vec3 spot_numbers(SampleKey key)
{
    return sample_block(key, every_lamp_blocks(CAMERA_BLOCKS, LAMP_COUNT)).xyz;
}

// First block of the vertex at a spot, like a later vertex's.
uint blocks_at_spot()
{
    return every_lamp_blocks(CAMERA_BLOCKS, LAMP_COUNT) + 1u;
}

// First block of a branch's vertex, 1 or later.
uint first_vertex_blocks()
{
    return blocks_of_sample();
}

uint later_vertex_blocks(uint vertex)
{
    return first_vertex_blocks() + vertex_blocks(1u, LAMP_COUNT) + (vertex - 2u) * vertex_blocks(2u, LAMP_COUNT);
}

// The choice of a lamp uses all 32 bits of a number.
struct ChosenLampNumbers {
    vec2 place;
    uint which;
};

ChosenLampNumbers chosen_lamp_numbers(SampleKey branch, uint begin)
{
    uvec4 words = sample_words(branch, begin);
    return ChosenLampNumbers(vec2(words.xy >> 8u) * NUMBER_STEP, words.z);
}

// Direction (x, y), lobe or cosine (z), survival (w), in a vertex's last block.
vec4 direction_numbers(SampleKey branch, uint begin, uint count)
{
    vec4 numbers = sample_block(branch, begin + count - 1u);
    return GLOSS == 1u ? numbers : numbers.xyzz;
}

// The number by which a vertex's ray passes surfaces at random (passes() of tree_walk.glsl); vertex 0 is the camera.
// Times a surface's odd number it is a coordinate of an extensible lattice in base 2 (Hickernell, Hong, L'Ecuyer and
// Lemieux 2000), shifted per pixel: 2^m samples fall into different ones of 2^m equal parts of [0, 1), and different
// surfaces decide independently.
uint opacity_number(SampleKey branch, uint vertex)
{
    const uint first_block = 1u << 31; // beyond all paths' blocks
    uint block = first_block + vertex;
    if (SAMPLER == SAMPLER_RANDOM)
        return sample_words(branch, block).x;
    return (bitfieldReverse(branch.sample_index) + branch.shift.w + branch.seed.y) * odd_number(block);
}

#endif
