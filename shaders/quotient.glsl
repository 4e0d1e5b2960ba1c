// Quotients of exact sums and counts as the bits of float32 numbers, by whole numbers alone: Vulkan bounds the error of
// a division of floats and may flush small ones to 0, while these bits are the same on every device, and on the host
// (lib/film/quotient.h).
#ifndef QUOTIENT_GLSL
#define QUOTIENT_GLSL

#extension GL_EXT_control_flow_attributes : require

// A whole number of up to 160 bits, least significant word first.
const uint NUMBER_WORDS = 5u;

// Its leading bits: (high * 2^32 + low) * 2^exponent, or more by less than 2^exponent if that is inexact. The top bit
// of high is set, unless the number is 0.
struct LeadingBits {
    uint high;
    uint low;
    int exponent;
    bool inexact;
};

// The upper word of two that are shifted to the left by less than 32 bits.
uint shifted_left(uint upper, uint lower, int bits)
{
    return upper << bits | (lower >> 1) >> (31 - bits);
}

LeadingBits leading_bits(uint words[NUMBER_WORDS])
{
    int exponent = 32 * int(NUMBER_WORDS - 2u);
    [[unroll]] for (uint i = 1u; i < NUMBER_WORDS; ++i)
        if (words[4] == 0u) {
            [[unroll]] for (uint word = NUMBER_WORDS - 1u; word > 0u; --word)
                words[word] = words[word - 1u];
            words[0] = 0u;
            exponent -= 32;
        }
    if (words[4] == 0u)
        return LeadingBits(0u, 0u, 0, false);
    int bits = 31 - findMSB(words[4]);
    bool inexact = (words[2] << bits | words[1] | words[0]) != 0u;
    return LeadingBits(shifted_left(words[4], words[3], bits), shifted_left(words[3], words[2], bits),
                       exponent - bits, inexact);
}

// quotient * 2^exponent, or a little more if that is inexact, rounded to nearest, ties to even. quotient has 25 bits at
// least. Beyond the largest float lies infinity.
uint rounded(uint quotient, int exponent, bool inexact)
{
    int top = findMSB(quotient);
    int magnitude = top + exponent; // the number is in [2^magnitude, 2^(magnitude + 1))
    if (magnitude > 127)
        return 0x7f800000u;
    // Of a float with the exponent -126 or less the last bit is 2^-149.
    int float_exponent = max(magnitude, -126);
    int dropped = min(top - 23 + float_exponent - magnitude, 31);
    uint kept = quotient >> dropped;
    uint rest = quotient & ((1u << dropped) - 1u);
    uint half_of_last = 1u << (dropped - 1);
    bool up = rest > half_of_last || (rest == half_of_last && (inexact || (kept & 1u) == 1u));
    // The leading one of a normal float adds the last 1 to the exponent's bits, and so does a carry.
    return (uint(float_exponent + 126) << 23) + kept + (up ? 1u : 0u);
}

// dividend * 2^exponent / divisor, rounded once; divisor >= 1. By long division: the quotient of two numbers with their
// top bits set lies between 1/2 and 2, and of its bits 26 are found, of which the first may be 0.
uint quotient_bits(LeadingBits dividend, uint divisor, int exponent)
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
        bool beyond = rest >= 0x80000000u; // its double has 33 bits
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

// The largest whole number whose square is no more than high * 2^32 + low, bit by bit.
uint square_root(uint high, uint low)
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

#endif
