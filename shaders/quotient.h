// Quotients of exact sums and counts, as the bits of float32. Computed with integers, because Vulkan permits errors of
// float division.
#ifndef PT_QUOTIENT_H
#define PT_QUOTIENT_H

#include "dialects.h"

#ifdef __cplusplus
namespace pt::gpu {
#endif

// Least significant word first.
PT_CONSTANT uint NUMBER_WORDS = 5u;
struct WholeNumber {
    uint words[NUMBER_WORDS];
};

PT_FUNCTION WholeNumber whole_number(uvec4 sum)
{
    WholeNumber number;
    PT_UNROLL for (int i = 0; i < int(FILM_SUM_WORDS); ++i)
        number.words[i] = sum[i];
    number.words[FILM_SUM_WORDS] = 0u;
    return number;
}

// The number (high 2^32 + low) 2^exponent. If inexact, the true number is larger by less than 2^exponent. The top bit
// of high is set unless the number is 0.
struct LeadingBits {
    uint high;
    uint low;
    int exponent;
    bool inexact;
};

// The upper word of two words shifted left; bits < 32.
PT_FUNCTION uint shifted_left(uint upper, uint lower, int bits)
{
    return upper << bits | (lower >> 1) >> (31 - bits);
}

PT_FUNCTION LeadingBits leading_bits(WholeNumber number)
{
    LeadingBits leading;
    leading.exponent = 32 * int(NUMBER_WORDS - 2u);
    PT_UNROLL for (uint i = 1u; i < NUMBER_WORDS; ++i)
        if (number.words[4] == 0u) {
            PT_UNROLL for (uint word = NUMBER_WORDS - 1u; word > 0u; --word)
                number.words[word] = number.words[word - 1u];
            number.words[0] = 0u;
            leading.exponent -= 32;
        }
    int bits = 31 - max(findMSB(number.words[4]), 0);
    leading.high = shifted_left(number.words[4], number.words[3], bits);
    leading.low = shifted_left(number.words[3], number.words[2], bits);
    leading.exponent -= bits;
    leading.inexact = (number.words[2] << bits | number.words[1] | number.words[0]) != 0u;
    return leading;
}

// Rounds quotient 2^exponent to nearest, ties to even. If inexact, the true number is slightly larger. quotient has at
// least 25 bits. Overflow gives infinity.
PT_FUNCTION uint rounded(uint quotient, int exponent, bool inexact)
{
    int top = findMSB(quotient);
    int magnitude = top + exponent; // the number is in [2^magnitude, 2^(magnitude + 1))
    if (magnitude > 127)
        return 0x7f800000u;
    // Below 2^-126 a float's last bit is 2^-149.
    int float_exponent = max(magnitude, -126);
    int dropped = min(top - 23 + float_exponent - magnitude, 31);
    uint kept = quotient >> dropped;
    uint rest = quotient & ((1u << dropped) - 1u);
    uint half_of_last = 1u << (dropped - 1);
    bool up = rest > half_of_last || (rest == half_of_last && (inexact || (kept & 1u) == 1u));
    // The leading one of `kept` adds 1 to the exponent, and so does a carry.
    return (uint(float_exponent + 126) << 23) + kept + (up ? 1u : 0u);
}

// Returns dividend 2^exponent / divisor, rounded once; divisor >= 1. This is a long division of numbers whose top bits
// are set. The quotient is in (1/2, 2) and has 26 bits, of which the first may be 0.
PT_FUNCTION uint quotient_bits(LeadingBits dividend, uint divisor, int exponent)
{
    if (dividend.high == 0u)
        return 0u;
    int bits = 31 - findMSB(divisor);
    uint normal_divisor = divisor << bits;
    uint quotient = dividend.high >= normal_divisor ? 1u : 0u;
    uint rest = dividend.high - (quotient == 1u ? normal_divisor : 0u);
    uint next = dividend.low;
    const int places = 25;
    int place = 0;
    do {
        bool beyond = rest >= 0x80000000u; // doubling would give 33 bits
        rest = rest << 1 | next >> 31;
        next <<= 1;
        bool fits = beyond || rest >= normal_divisor;
        rest -= fits ? normal_divisor : 0u;
        quotient = quotient << 1 | (fits ? 1u : 0u);
        ++place;
    } while (place < places);
    return rounded(quotient, dividend.exponent + exponent + bits + 32 - places,
                   dividend.inexact || (rest | next) != 0u);
}

// Returns the bits of sum 2^exponent / count; 0 without samples.
PT_FUNCTION uint mean_bits(uvec4 sum, uint count, int exponent)
{
    return count == 0u ? 0u : quotient_bits(leading_bits(whole_number(sum)), count, exponent);
}

// floor(sqrt(high 2^32 + low)).
PT_FUNCTION uint square_root(uint high, uint low)
{
    uint root = 0u;
    uint bit = 0x80000000u;
    do {
        uint square_high, square_low;
        umulExtended(root | bit, root | bit, square_high, square_low);
        if (square_high < high || (square_high == high && square_low <= low))
            root |= bit;
        bit >>= 1;
    } while (bit != 0u);
    return root;
}

PT_FUNCTION WholeNumber product(uvec4 sum, uint count)
{
    WholeNumber number;
    uint carry = 0u;
    PT_UNROLL for (int i = 0; i < int(FILM_SUM_WORDS); ++i) {
        uint high, low, overflow;
        umulExtended(sum[i], count, high, low);
        number.words[i] = uaddCarry(low, carry, overflow);
        carry = high + overflow;
    }
    number.words[FILM_SUM_WORDS] = carry;
    return number;
}

// a - b modulo 2^160. borrow is 1 if a < b.
PT_FUNCTION WholeNumber difference(WholeNumber a, WholeNumber b, PT_OUT(uint) borrow)
{
    borrow = 0u;
    PT_UNROLL for (uint i = 0u; i < NUMBER_WORDS; ++i) {
        uint first_borrow, second_borrow;
        uint partial = usubBorrow(a.words[i], b.words[i], first_borrow);
        a.words[i] = usubBorrow(partial, borrow, second_borrow);
        borrow = first_borrow | second_borrow;
    }
    return a;
}

// Sum A has a samples, and sum B has b samples. Returns |A b - B a|, and whether A / a < B / b.
PT_FUNCTION WholeNumber weighted_difference(uvec4 sum_a, uint a, uvec4 sum_b, uint b, PT_OUT(bool) first_is_less)
{
    uint borrow;
    WholeNumber number = difference(product(sum_a, b), product(sum_b, a), borrow);
    first_is_less = borrow == 1u;
    // -x = ~x + 1
    uint mask = first_is_less ? 0xffffffffu : 0u;
    uint carry = borrow;
    PT_UNROLL for (uint i = 0u; i < NUMBER_WORDS; ++i)
        number.words[i] = uaddCarry(number.words[i] ^ mask, carry, carry);
    return number;
}

// The divisor (a + b) sqrt(a b) of the standard error |A b - B a| / ((a + b) sqrt(a b)) (shaders/README.md, section
// 11). The numerator is exact. Root and divisor are truncated to 32 bits, with relative errors below 2^-31. So the
// error of the standard error is below 0.52 ulp.
struct ErrorDivisor {
    uint divisor; // its top bit is set
    int exponent; // the value is divisor 2^exponent
};

PT_FUNCTION ErrorDivisor error_divisor(uint a, uint b)
{
    // Takes the root of a b 2^(2 shift). One of the top two bits of this number is set.
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

    ErrorDivisor result;
    uint high, low;
    umulExtended(a + b, root, high, low);
    int bits = 31 - findMSB(high);
    result.divisor = shifted_left(high, low, bits);
    result.exponent = shift + bits - 32;
    return result;
}

PT_FUNCTION uint standard_error_bits(WholeNumber numerator, ErrorDivisor divisor, int exponent)
{
    return quotient_bits(leading_bits(numerator), divisor.divisor, exponent + divisor.exponent);
}

#ifdef __cplusplus
} // namespace pt::gpu
#endif
#endif
