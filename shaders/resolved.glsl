// Writes pixels that are read back, in each format. Float16 is computed with integers, as on the host
// (lib/film/pixel_format.h), because Vulkan does not fix how packHalf2x16 rounds and whether it flushes small numbers.
#ifndef RESOLVED_GLSL
#define RESOLVED_GLSL

#extension GL_EXT_control_flow_attributes : require

#include "gpu_layout.h"

layout(set = 0, binding = BINDING_RESOLVED) writeonly buffer Resolved { uint words[]; } resolved;
layout(set = 0, binding = BINDING_FINDINGS) buffer Findings { uint lost_pixels; } findings;

const uint SIGN_BIT = 0x80000000u;
const uint HALF_INFINITY_BITS = 0x7c00u;
const uint HALF_ONE_BITS = 0x3c00u;

// Rounds a float32 >= 0 to the nearest float16, ties to even. Values from 65520 on become infinity.
uint half_bits(uint float_bits)
{
    const uint smallest_normal = 0x38800000u; // 2^-14
    const uint difference_of_biases = 0x38000000u;
    // Below 2^-14 the last bit is 2^-24.
    bool normal = float_bits >= smallest_normal;
    uint number = normal ? float_bits - difference_of_biases : (float_bits & 0x7fffffu) | 0x800000u;
    uint dropped = normal ? 13u : min(126u - (float_bits >> 23), 25u);
    uint kept = number >> dropped;
    uint rest = number & ((1u << dropped) - 1u);
    uint half_of_last = 1u << (dropped - 1u);
    bool up = rest > half_of_last || (rest == half_of_last && (kept & 1u) == 1u);
    // A carry increments the exponent; beyond the largest number it gives infinity.
    return min(kept + (up ? 1u : 0u), HALF_INFINITY_BITS);
}

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
