// Exact sums of samples in 128-bit fixed point (shaders/README.md, section 11; layout: gpu_layout.h).
#ifndef FILM_GLSL
#define FILM_GLSL

#extension GL_EXT_control_flow_attributes : require

#include "gpu_layout.h"

layout(set = 0, binding = BINDING_FILM) buffer Film { uint words[]; } film;

struct FilmPixel {
    uvec4 windows[3];
    uint accepted;
    uint rejected;
};

FilmPixel empty_film_pixel()
{
    return FilmPixel(uvec4[3](uvec4(0u), uvec4(0u), uvec4(0u)), 0u, 0u);
}

// Adding these biases splits a value into windows of bits (shaders/README.md, section 11; Demmel and Nguyen 2013). A
// window is below 2^22 units even with rounding towards zero, so the sum of 511 windows fits into 32 bits.
const vec4 WINDOW_BIASES = vec4(536870912.0, 192.0, 4.57763671875e-5, 1.0913936421275139e-11);

// The result includes the biases' bits, which film_store() subtracts modulo 2^32.
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

// Adds a sample in film units. NaN, infinite, negative and too bright samples are counted and left out.
void film_add(inout FilmPixel pixel, vec3 value)
{
    // Bits are compared, because Vulkan does not define comparisons with NaN. All unacceptable values have bits above
    // the limit.
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

// The first window is unsigned; the other windows are in two's complement.
uvec4 fixed_point(uvec4 windows)
{
    uvec3 sign = uvec3(ivec3(windows.yzw) >> 31);
    uvec4 a = uvec4(0u, 0u, windows.x << 2u, windows.x >> 30u);                               // times 2^66
    uvec4 b = uvec4(0u, windows.y << 12u, uint(int(windows.y) >> 20), sign.x);                // times 2^44
    uvec4 c = uvec4(windows.z << 22u, uint(int(windows.z) >> 10), sign.y, sign.y);            // times 2^22
    uvec4 d = uvec4(windows.w, sign.z, sign.z, sign.z);
    return add_with_carry(add_with_carry(a, b), add_with_carry(c, d));
}

// Adds to the three low words of a sum, and returns the addend of the highest word. If is_first, the old sum is not
// read and counts as 0.
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

// Planes that rarely change: highest words of the sums, and the number of rejected samples.
uint rare_plane(uint i) { return i < 3u ? (i + 1u) * FILM_SUM_WORDS - 1u : FILM_REJECTED; }

// pixel is the index of the pixel's first word in a part. The loop usually has one iteration; lavapipe 22.3 would
// always execute the bodies of four ifs.
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

// For pixels to which several invocations add. Words are added atomically, so exactly one invocation sees each
// overflow.
void film_store_shared_sum(uint first, uint stride, uvec4 sum)
{
    uint carry = 0u;
    [[unroll]] for (uint i = 0u; i < FILM_SUM_WORDS; ++i) {
        uint addend = sum[i] + carry; // 0 after overflow, which keeps the carry
        carry = addend < carry ? 1u : 0u;
        if (addend != 0u) {
            uint old = atomicAdd(film.words[first + i * stride], addend);
            carry += old + addend < addend ? 1u : 0u;
        }
    }
}

// shared_pixel: other invocations may add to the pixel at the same time. is_first: the part has no sample of the pixel,
// and only its rare words are initialised to 0.
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

void film_store_covered(uint pixel_in_strip, uint strip_pixel_count, uint count, bool shared_pixel)
{
    uint word = FILM_COVERED * strip_pixel_count + pixel_in_strip;
    if (shared_pixel)
        atomicAdd(film.words[word], count);
    else
        film.words[word] += count;
}

#endif
