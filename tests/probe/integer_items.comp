// Evaluates the shipped functions that work on integers: hash, scrambling, fixed point.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "film.glsl"
#include "sampler.glsl"

#include "items.glsl"

struct Item { uvec4 words; uvec4 seeds; };
struct Result { uvec4 hash; uvec4 scrambled; uvec4 units; };
layout(set = 0, binding = 2) writeonly buffer Output { Result results[]; };
layout(set = 0, binding = 3) readonly buffer Input { Item items[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (!is_item(index))
        return;
    uvec4 words = items[index].words;
    results[index] = Result(pcg4d(words), owen_scrambled(words, items[index].seeds),
                            fixed_point(uintBitsToFloat(items[index].seeds.x)));
}
