// Exact sums of samples: 128-bit fixed point, so that addition commutes and associates. Used by pathtrace.comp,
// fold.comp and add.comp; gpu_layout.h has the layout, lib/film/film.cpp reads it.
#ifndef FILM_GLSL
#define FILM_GLSL

#extension GL_EXT_control_flow_attributes : require

#include "gpu_layout.h"

layout(set = 0, binding = BINDING_FILM) buffer Film { uint words[]; } film;

// What an invocation gathers: sums of windows, including their biases, which are then added to the film.
struct FilmPixel {
    uvec4 windows[3];
    uint accepted;
    uint rejected;
};

FilmPixel empty_film_pixel()
{
    return FilmPixel(uvec4[3](uvec4(0u), uvec4(0u), uvec4(0u)), 0u, 0u);
}

// A sum of floats is exact as long as no addition rounds. So each value is cut into four windows, multiples of 2^6,
// 2^-16, 2^-38 and 2^-60 that add up to it, each small enough for 511 of them to sum up in 32 bits (the pre-rounded
// sums of Demmel and Nguyen, "Fast Reproducible Floating-Point Summation", ARITH 2013). Adding a bias of three halves
// (of one, where the value has no sign) of a power of two rounds a number to a multiple of that power's 2^-23 and
// leaves the multiple in the low bits: no shift, no carry, nothing that depends on the sum so far. Where a value has
// bits below 2^-60 (2^-37 and more have none), it is rounded.
// Vulkan does not say which of its two neighbours a sum is rounded to. To nearest, what is left for the next window is
// at most half of a window's unit; towards zero, less than a whole one. So a window holds less than 2^22 of its own
// units, and 511 of them less than 2^31. Either way nothing is lost: differences of a number and its rounded one are
// exact here.
const vec4 WINDOW_BIASES = vec4(536870912.0, 192.0, 4.57763671875e-5, 1.0913936421275139e-11);

// These sums contain the bits of the biases too. They are subtracted once at the end, which is exact modulo 2^32.
uvec4 windows_of(float value)
{
    precise float a = value + WINDOW_BIASES.x;
    precise float rest_a = value - (a - WINDOW_BIASES.x);
    precise float b = rest_a + WINDOW_BIASES.y;
    precise float rest_b = rest_a - (b - WINDOW_BIASES.y);
    precise float c = rest_b + WINDOW_BIASES.z;
    precise float rest_c = rest_b - (c - WINDOW_BIASES.z);
    precise float d = rest_c + WINDOW_BIASES.w;
    return floatBitsToUint(vec4(a, b, c, d));
}

// Adds a sample in film units, or counts it as left out if a component is NaN, infinite, negative or too bright.
void film_add(inout FilmPixel pixel, vec3 value)
{
    // As integers, since Vulkan does not promise how comparisons treat NaN: floats >= 0 are ordered as their bits
    // are, and negative ones, infinity and NaN lie above.
    const uint limit = (127u + FILM_MAX_EXPONENT) << 23u;
    uvec3 bits = floatBitsToUint(value);
    bool accepted = max(max(bits.r, bits.g), bits.b) < limit;
    vec3 kept = accepted ? value : vec3(0.0);
    pixel.windows[0] += windows_of(kept.r);
    pixel.windows[1] += windows_of(kept.g);
    pixel.windows[2] += windows_of(kept.b);
    pixel.accepted += accepted ? 1u : 0u;
    pixel.rejected += accepted ? 0u : 1u;
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

// Sums of windows as one fixed-point number of 128 bits. The first is not negative; the others are signed, in two's
// complement.
uvec4 fixed_point(uvec4 windows)
{
    uvec3 sign = uvec3(ivec3(windows.yzw) >> 31);
    uvec4 a = uvec4(0u, 0u, windows.x << 2u, windows.x >> 30u);                               // times 2^66
    uvec4 b = uvec4(0u, windows.y << 12u, uint(int(windows.y) >> 20), sign.x);                // times 2^44
    uvec4 c = uvec4(windows.z << 22u, uint(int(windows.z) >> 10), sign.y, sign.y);            // times 2^22
    uvec4 d = uvec4(windows.w, sign.z, sign.z, sign.z);
    return add_with_carry(add_with_carry(a, b), add_with_carry(c, d));
}

// Adds to the three least significant words of a sum, which begin at words[first] and lie stride apart. Returns what is to
// be added to the most significant one. is_first: the sum is 0, whatever the words hold. They are not read then, as the end
// of an invocation spends its time on memory.
uint film_store_sum(uint first, uint stride, uvec4 sum, bool is_first)
{
    uvec4 old = uvec4(0u);
    if (!is_first)
        old = uvec4(film.words[first], film.words[first + stride], film.words[first + 2u * stride], 0u);
    uvec4 new = add_with_carry(old, sum);
    film.words[first] = new.x;
    film.words[first + stride] = new.y;
    film.words[first + 2u * stride] = new.z;
    return new.w;
}

// The plane of a word that hardly ever changes: the most significant ones of the three sums, and the samples left out.
uint rare_plane(uint i) { return i < 3u ? (i + 1u) * FILM_SUM_WORDS - 1u : FILM_REJECTED; }

// Adds to these words. pixel: the first word of a pixel in a part. A loop that makes a single trip except for pixels
// that need more, since lavapipe 22.3 executes the bodies of all ifs.
void film_add_rare_words(uint pixel, uint stride, uvec4 addends)
{
    uint i = addends.x != 0u ? 0u : addends.y != 0u ? 1u : addends.z != 0u ? 2u : 3u;
    do {
        uint addend = i == 0u ? addends.x : i == 1u ? addends.y : i == 2u ? addends.z : addends.w;
        if (addend != 0u)
            film.words[pixel + rare_plane(i) * stride] += addend;
        ++i;
    } while (i < 4u);
}

// The same where several invocations add to a pixel: each word takes its addend and the carry of the word before at
// once, in whatever order. That a word has overflowed is seen by exactly one of those who add to it.
void film_store_shared_sum(uint first, uint stride, uvec4 sum)
{
    uint carry = 0u;
    [[unroll]] for (uint i = 0u; i < FILM_SUM_WORDS; ++i) {
        uint addend = sum[i] + carry; // 0, with a carry, where that overflows
        carry = addend < carry ? 1u : 0u;
        if (addend != 0u) {
            uint old = atomicAdd(film.words[first + i * stride], addend);
            carry += old + addend < addend ? 1u : 0u;
        }
    }
}

// Adds what an invocation has gathered to its pixel in one part of the film. shared_pixel: other invocations may do the
// same at that time. Otherwise, is_first: the part has no sample of the pixel yet, and its words hold anything, except
// that the rare ones are 0.
void film_store(uint film_part, uint pixel_in_strip, uint strip_pixel_count, FilmPixel pixel, bool shared_pixel,
                bool is_first)
{
    uint stride = strip_pixel_count;
    uint first = film_part * FILM_WORDS * stride + pixel_in_strip;
    uint accepted = first + FILM_ACCEPTED * stride;
    uvec4 biases = (pixel.accepted + pixel.rejected) * floatBitsToUint(WINDOW_BIASES);
    uvec4 rare = uvec4(0u, 0u, 0u, pixel.rejected);
    [[unroll]] for (uint channel = 0u; channel < 3u; ++channel) {
        uint first_of_channel = first + channel * FILM_SUM_WORDS * stride;
        uvec4 sum = fixed_point(pixel.windows[channel] - biases);
        if (shared_pixel)
            film_store_shared_sum(first_of_channel, stride, sum);
        else
            rare[channel] = film_store_sum(first_of_channel, stride, sum, is_first);
    }
    if (shared_pixel) {
        atomicAdd(film.words[accepted], pixel.accepted);
        if (pixel.rejected != 0u)
            atomicAdd(film.words[first + FILM_REJECTED * stride], pixel.rejected);
    } else {
        uint before = 0u;
        if (!is_first)
            before = film.words[accepted];
        film.words[accepted] = before + pixel.accepted;
        film_add_rare_words(first, stride, rare);
    }
}

#endif
