// Float16 by integers, because Vulkan does not fix how packHalf2x16 rounds and whether it flushes small numbers.
#ifndef PT_HALF_H
#define PT_HALF_H

#include "dialects.h"

#ifdef __cplusplus
namespace pt::gpu {
#endif

PT_CONSTANT uint HALF_INFINITY_BITS = 0x7c00u;

// Rounds a float32 >= 0 to the nearest float16, ties to even.
PT_FUNCTION uint half_bits(uint float_bits)
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

#ifdef __cplusplus
} // namespace pt::gpu
#endif
#endif
