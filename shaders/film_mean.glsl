// What the sums of a pixel say: the mean of its samples, and the standard error of that mean.
#ifndef FILM_MEAN_GLSL
#define FILM_MEAN_GLSL

#include "film.glsl"
#include "quotient.glsl"

// The infinity of float32.
const uint INFINITY_BITS = 0x7f800000u;

// Samples of a pixel in a part of the film.
struct PartCount {
    uint accepted;
    uint done; // accepted or left out
};

PartCount part_count(uint part, uint pixel_in_strip, uint strip_pixel_count)
{
    uint first = part * FILM_WORDS * strip_pixel_count + pixel_in_strip;
    uint accepted = film.words[first + FILM_ACCEPTED * strip_pixel_count];
    return PartCount(accepted, accepted + film.words[first + FILM_REJECTED * strip_pixel_count]);
}

uvec4 part_sum(uint part, uint channel, uint pixel_in_strip, uint strip_pixel_count)
{
    uint first = (part * FILM_WORDS + channel * FILM_SUM_WORDS) * strip_pixel_count + pixel_in_strip;
    return uvec4(film.words[first], film.words[first + strip_pixel_count], film.words[first + 2u * strip_pixel_count],
                 film.words[first + 3u * strip_pixel_count]);
}

// The bits of sum * 2^exponent / count; 0 of no sample.
uint mean_bits(uvec4 sum, uint count, int exponent)
{
    if (count == 0u)
        return 0u;
    return quotient_bits(leading_bits(uint[NUMBER_WORDS](sum.x, sum.y, sum.z, sum.w, 0u)), count, exponent);
}

// A sum times a count.
uint[NUMBER_WORDS] product(uvec4 sum, uint count)
{
    uint words[NUMBER_WORDS];
    uint carry = 0u;
    [[unroll]] for (uint i = 0u; i < FILM_SUM_WORDS; ++i) {
        uint high, low, overflow;
        umulExtended(sum[i], count, high, low);
        words[i] = uaddCarry(low, carry, overflow);
        carry = high + overflow;
    }
    words[FILM_SUM_WORDS] = carry;
    return words;
}

// a - b modulo 2^160; borrow: 1 if a < b.
uint[NUMBER_WORDS] difference(uint a[NUMBER_WORDS], uint b[NUMBER_WORDS], out uint borrow)
{
    uint words[NUMBER_WORDS];
    borrow = 0u;
    [[unroll]] for (uint i = 0u; i < NUMBER_WORDS; ++i) {
        uint first_borrow, second_borrow;
        uint partial = usubBorrow(a[i], b[i], first_borrow);
        words[i] = usubBorrow(partial, borrow, second_borrow);
        borrow = first_borrow | second_borrow;
    }
    return words;
}

// |A b - B a| of the sums A of a samples and B of b. first_is_less: A / a < B / b.
uint[NUMBER_WORDS] weighted_difference(uvec4 sum_a, uint a, uvec4 sum_b, uint b, out bool first_is_less)
{
    uint borrow;
    uint words[NUMBER_WORDS] = difference(product(sum_a, b), product(sum_b, a), borrow);
    first_is_less = borrow == 1u;
    // The negative of a number is its complement and 1.
    uint mask = first_is_less ? 0xffffffffu : 0u;
    uint carry = borrow;
    [[unroll]] for (uint i = 0u; i < NUMBER_WORDS; ++i)
        words[i] = uaddCarry(words[i] ^ mask, carry, carry);
    return words;
}

// The bits of the standard error of the mean of both parts, each of one sample at least:
// s = |A / a - B / b| sqrt(a b) / (a + b) = |A b - B a| / ((a + b) sqrt(a b)), times 2^exponent
// (README.md, section 11). The numerator is exact; the root is cut to 32 bits and so is the denominator, each by less
// than a 2^31th: the rounded result is within .52 of its last place.
uint standard_error_bits(uvec4 sum_a, uint a, uvec4 sum_b, uint b, int exponent)
{
    bool unused;
    uint words[NUMBER_WORDS] = weighted_difference(sum_a, a, sum_b, b, unused);

    // The root of a b 2^(2 shift), of which one of the top two bits is set.
    uint square_high, square_low;
    umulExtended(a, b, square_high, square_low);
    int zeros = square_high != 0u ? 31 - findMSB(square_high) : 63 - findMSB(square_low);
    int shift = zeros / 2;
    if (shift >= 16) {
        square_high = square_low;
        square_low = 0u;
    }
    int rest_of_shift = 2 * (shift & 15);
    uint root = square_root(shifted_left(square_high, square_low, rest_of_shift), square_low << rest_of_shift);

    uint denominator_high, denominator_low;
    umulExtended(a + b, root, denominator_high, denominator_low);
    int bits = 31 - findMSB(denominator_high);
    uint denominator = shifted_left(denominator_high, denominator_low, bits);
    return quotient_bits(leading_bits(words), denominator, exponent + shift + bits - 32);
}

#endif
