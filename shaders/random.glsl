// Random numbers as a pure function of (seed, pixel, sample, dimension), so that a sample's value depends on nothing else.
// Used by path.glsl.
#ifndef RANDOM_GLSL
#define RANDOM_GLSL

struct SampleKey {
    uvec2 seed;
    uint pixel;  // index in the image, row by row
    uint sample_index;
};

// The hash pcg4d of Jarzynski and Olano, "Hash Functions for GPU Rendering" (JCGT 9(3), 2020), table 1 and listing 4: four
// random words of four words of input, for seven integer operations each.
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

// Who owns which block of four dimensions: none is used twice.
//   block 0            place in the pixel (x, y), time (z)
//   block 2 v - 1      lamp at vertex v = 1, 2, ...: which (x), place on it (y, z)
//   block 2 v          direction at vertex v: which lobe (x), direction (y, z)
const uint BLOCK_CAMERA = 0u;
uint lamp_block(uint vertex) { return 2u * vertex - 1u; }
uint direction_block(uint vertex) { return 2u * vertex; }

// Four uniform random numbers in [0, 1), multiples of 2^-24 so that rounding never gives 1.
vec4 random_4d(SampleKey key, uint block)
{
    uvec4 words = pcg4d(uvec4(key.pixel, key.sample_index, block + key.seed.x, key.seed.y));
    return vec4(words >> 8u) * (1.0 / 16777216.0);
}

#endif
