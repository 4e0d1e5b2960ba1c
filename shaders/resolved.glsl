// Writes pixels that are read back, in each format.
#ifndef RESOLVED_GLSL
#define RESOLVED_GLSL

#extension GL_EXT_control_flow_attributes : require

#include "half.h"

layout(set = 0, binding = BINDING_RESOLVED) writeonly buffer Resolved { uint words[]; } resolved;
layout(set = 0, binding = BINDING_FINDINGS) buffer Findings { uint lost_pixels; } findings;

const uint SIGN_BIT = 0x80000000u;
const uint HALF_ONE_BITS = 0x3c00u;

uint signed_half_bits(uint float_bits)
{
    return half_bits(float_bits & ~SIGN_BIT) | ((float_bits & SIGN_BIT) >> 16u);
}

uint words_of_pixel(uint format)
{
    return format == FORMAT_R32UI ? 1u : format == FORMAT_RGBA16F ? 2u : format == FORMAT_RGBA32F ? 4u : 3u;
}

// value has the bits of three floats, or an integer in x.
void write_pixel(uint first_word, uint format, uvec3 value)
{
    if (format == FORMAT_R32UI) {
        resolved.words[first_word] = value.x;
    } else if (format == FORMAT_RGBA16F) {
        uvec3 halves = uvec3(signed_half_bits(value.x), signed_half_bits(value.y), signed_half_bits(value.z));
        resolved.words[first_word] = halves.x | halves.y << 16u;
        resolved.words[first_word + 1u] = halves.z | HALF_ONE_BITS << 16u;
    } else {
        [[unroll]] for (uint channel = 0u; channel < 3u; ++channel)
            resolved.words[first_word + channel] = value[channel];
        if (format == FORMAT_RGBA32F)
            resolved.words[first_word + 3u] = floatBitsToUint(1.0);
    }
}

#endif
