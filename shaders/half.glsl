// The bits of float16 numbers, computed with integers: Vulkan leaves to the device how packHalf2x16 rounds and whether
// it keeps small numbers. These bits are the same on every device and on the host (lib/film/pixel_format.h).
#ifndef HALF_GLSL
#define HALF_GLSL

const uint HALF_INFINITY_BITS = 0x7c00u;
const uint HALF_ONE_BITS = 0x3c00u;

// For a float32 that is >= 0, or infinity: rounded to nearest, ties to even. From 65520 on the result is infinity.
uint half_bits(uint float_bits)
{
    const uint smallest_normal = 0x38800000u; // 2^-14
    const uint difference_of_biases = 0x38000000u;
    // Below 2^-14 the last bit is 2^-24, and below 2^-25 everything becomes 0.
    bool normal = float_bits >= smallest_normal;
    uint number = normal ? float_bits - difference_of_biases : (float_bits & 0x7fffffu) | 0x800000u;
    uint dropped = normal ? 13u : min(126u - (float_bits >> 23), 25u);
    uint kept = number >> dropped;
    uint rest = number & ((1u << dropped) - 1u);
    uint half_of_last = 1u << (dropped - 1u);
    bool up = rest > half_of_last || (rest == half_of_last && (kept & 1u) == 1u);
    // A carry goes into the exponent, and turns the largest number into infinity.
    return min(kept + (up ? 1u : 0u), HALF_INFINITY_BITS);
}

#endif
