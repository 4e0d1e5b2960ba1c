// Exact sums of samples: 128-bit fixed point, so that addition commutes and associates. Used by pathtrace.comp and
// commit.comp; gpu_layout.h has the layout, lib/film.cpp reads it.
#ifndef FILM_GLSL
#define FILM_GLSL

#include "gpu_layout.h"

layout(set = 0, binding = BINDING_FILM) buffer Film { uint words[]; } film;

struct FilmPixel {
    uvec4 sums[3];
    uint accepted;
    uint rejected;
};

// Index of the one of the samples 2 * pair and 2 * pair + 1 that belongs to a half: bit 0 adds to the parity of the
// other bits that are in the mask.
uint sample_of_pair(uint pair, uint film_half, uint mask)
{
    uint even = pair << 1u;
    return even | ((uint(bitCount(even & mask)) ^ film_half) & 1u);
}

FilmPixel empty_film_pixel()
{
    return FilmPixel(uvec4[3](uvec4(0u), uvec4(0u), uvec4(0u)), 0u, 0u);
}

uvec4 add_with_carry(uvec4 a, uvec4 b)
{
    uvec4 sum;
    uint carry, carry_again;
    sum.x = uaddCarry(a.x, b.x, carry);
    sum.y = uaddCarry(a.y, b.y, carry_again);
    sum.y = uaddCarry(sum.y, carry, carry);
    carry += carry_again;
    sum.z = uaddCarry(a.z, b.z, carry_again);
    sum.z = uaddCarry(sum.z, carry, carry);
    sum.w = a.w + b.w + carry + carry_again;
    return sum;
}

// A float in [0, 2^FILM_MAX_EXPONENT) as fixed point: its 24-bit mantissa m, shifted into place. value = m 2^(e -
// 150) for the biased exponent e, so m moves left by e - 150 + FILM_FRACTION_BITS. Bits below the fraction are cut
// off: values below 2^-41 lose some.
uvec4 fixed_point(float value)
{
    uint bits = floatBitsToUint(value) & 0x7fffffffu;
    uint biased_exponent = bits >> 23u;
    uint mantissa = (bits & 0x7fffffu) | 0x800000u;
    const uint unit_exponent = 150u - FILM_FRACTION_BITS;
    uint right = biased_exponent < unit_exponent ? min(unit_exponent - biased_exponent, 31u) : 0u;
    uint left = biased_exponent < unit_exponent ? 0u : biased_exponent - unit_exponent;
    mantissa >>= right;
    uint low = mantissa << (left & 31u);
    uint high = (mantissa >> 1u) >> (31u - (left & 31u)); // two steps: a shift by 32 is undefined
    uint word = left >> 5u;                               // at most 2, as the value is below 2^28
    return uvec4(word == 0u ? low : 0u, word == 0u ? high : word == 1u ? low : 0u,
                 word == 1u ? high : word == 2u ? low : 0u, word == 2u ? high : 0u);
}

// Adds a sample in film units, or counts it as left out if a component is NaN, infinite, negative or too bright.
void film_add(inout FilmPixel pixel, vec3 value)
{
    // As integers, since Vulkan does not promise how comparisons treat NaN: floats >= 0 are ordered as their bits
    // are, and negative ones, infinity and NaN lie above. Minus zero is a zero.
    const uint limit = (127u + FILM_MAX_EXPONENT) << 23u;
    uvec3 bits = floatBitsToUint(value);
    bvec3 zero = equal(bits, uvec3(0x80000000u));
    bvec3 in_range = lessThan(bits, uvec3(limit));
    bool accepted = (in_range.r || zero.r) && (in_range.g || zero.g) && (in_range.b || zero.b);
    vec3 kept = accepted ? value : vec3(0.0);
    pixel.sums[0] = add_with_carry(pixel.sums[0], fixed_point(kept.r));
    pixel.sums[1] = add_with_carry(pixel.sums[1], fixed_point(kept.g));
    pixel.sums[2] = add_with_carry(pixel.sums[2], fixed_point(kept.b));
    pixel.accepted += accepted ? 1u : 0u;
    pixel.rejected += accepted ? 0u : 1u;
}

// Adds to the sum whose least significant word is words[first], its words lying stride apart. The most significant one
// hardly ever changes, and memory is what an invocation's end costs.
void film_store_sum(uint first, uint stride, uvec4 sum)
{
    uvec4 old = uvec4(film.words[first], film.words[first + stride], film.words[first + 2u * stride], 0u);
    uvec4 new = add_with_carry(old, sum);
    film.words[first] = new.x;
    film.words[first + stride] = new.y;
    film.words[first + 2u * stride] = new.z;
    if (new.w != 0u)
        film.words[first + 3u * stride] += new.w;
}

// Adds what an invocation has gathered to its pixel of the strip, in one half of the film.
void film_store(uint film_half, uint pixel_in_strip, uint strip_pixel_count, FilmPixel pixel)
{
    uint first = film_half * FILM_WORDS * strip_pixel_count + pixel_in_strip;
    film_store_sum(first, strip_pixel_count, pixel.sums[0]);
    film_store_sum(first + FILM_SUM_WORDS * strip_pixel_count, strip_pixel_count, pixel.sums[1]);
    film_store_sum(first + 2u * FILM_SUM_WORDS * strip_pixel_count, strip_pixel_count, pixel.sums[2]);
    film.words[first + FILM_ACCEPTED * strip_pixel_count] += pixel.accepted;
    if (pixel.rejected != 0u)
        film.words[first + FILM_REJECTED * strip_pixel_count] += pixel.rejected;
}

#endif
