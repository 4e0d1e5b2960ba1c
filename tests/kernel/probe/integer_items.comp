#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "film.glsl"
#include "sampler.glsl"

#include "items.glsl"

struct Item { uvec4 words; uvec4 number; };
struct Result { uvec4 hash; uvec4 units; };
layout(set = 0, binding = 2) writeonly buffer Output { Result results[]; };
layout(set = 0, binding = 3) readonly buffer Input { Item items[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (!is_item(index))
        return;
    uvec4 windows = windows_of(uintBitsToFloat(items[index].number.x)) - floatBitsToUint(WINDOW_BIASES);
    results[index] = Result(pcg4d(items[index].words), fixed_point(windows));
}
