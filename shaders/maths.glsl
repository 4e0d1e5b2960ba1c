// Elementary functions with stated errors, which lib/accuracy.cpp derives and pt_get_accuracy measures, where Vulkan
// promises too little: sin and cos only 2^-11 absolute, log2 2^-21 absolute near 1, and so pow almost nothing for large
// exponents. Used by sampling.glsl and phong.glsl.
#ifndef MATHS_GLSL
#define MATHS_GLSL

const float PI = 3.14159265358979;

// 1.5 * 2^23: adding it to |x| < 2^22 leaves round(x) in the low bits of the mantissa. Float-to-int conversion would do
// too, but is many times slower where it is not a machine instruction.
const float ROUNDING_BIAS = 12582912.0;

// sin and cos of 2 pi u for u in [0, 1], each within 3.5 ulp, also near its zeros.
// The turn is reduced to the nearest quarter, exactly, so that the Taylor polynomials of degree 9 and 8 see at most an
// eighth of a turn: their remainders there are (pi/4)^11 / 11! = 2e-9 and (pi/4)^10 / 10! = 2.5e-8.
void sin_cos_turn(float u, out float sine, out float cosine)
{
    precise float biased = 4.0 * u + ROUNDING_BIAS;
    precise float quarters = biased - ROUNDING_BIAS;
    uint quadrant = floatBitsToUint(biased) & 3u;
    float x = 2.0 * PI * (u - 0.25 * quarters);
    float x2 = x * x;
    float s = x * (1.0 + x2 * (-1.0 / 6.0 + x2 * (1.0 / 120.0 + x2 * (-1.0 / 5040.0 + x2 * (1.0 / 362880.0)))));
    float c = 1.0 + x2 * (-0.5 + x2 * (1.0 / 24.0 + x2 * (-1.0 / 720.0 + x2 * (1.0 / 40320.0))));
    bool odd = (quadrant & 1u) != 0u;
    sine = odd ? c : s;
    cosine = odd ? s : c;
    sine = quadrant >= 2u ? -sine : sine;
    cosine = quadrant == 1u || quadrant == 2u ? -cosine : cosine;
}

// log(1 - y) for y in [0, 1), within 8 ulp. 1 - y = 2^e m with m in [sqrt(1/2), sqrt(2)), log m = 2
// atanh(s) with s = (m - 1) / (m + 1), |s| <= 0.172: the series is cut at s^11 / 11, 2e-9 of its first term. For e =
// 0, m - 1 is -y itself, which keeps full precision as y goes to 0.
float log_one_minus(float y)
{
    float x = 1.0 - y;
    int exponent_bits = (floatBitsToInt(x) - 0x3f3504f3) & ~0x7fffff;
    float m_minus_one = exponent_bits == 0 ? -y : intBitsToFloat(floatBitsToInt(x) - exponent_bits) - 1.0;
    float s = m_minus_one / (2.0 + m_minus_one);
    float s2 = s * s;
    float log_m = 2.0 * s * (1.0 + s2 * (1.0 / 3.0 + s2 * (1.0 / 5.0 + s2 * (1.0 / 7.0 + s2 * (1.0 / 9.0)))));
    return float(exponent_bits >> 23) * 0.693147181 + log_m;
}

// exp(x) - 1 for x in [-69, 0], as 2^k and e with exp(x) - 1 = 2^k e + (2^k - 1) and e = exp(r) - 1, |r| <= ln(2) / 2.
// The Taylor polynomial of e is cut at r^8 / 8!, 5e-9. The two halves of ln 2 (Cody and Waite 1980) make k ln 2 exact.
void exp_parts(float x, out float power, out float e)
{
    precise float biased = x * 1.44269504 + ROUNDING_BIAS;
    precise float k = biased - ROUNDING_BIAS;
    precise float r = (x - k * 0.693359375) + k * 2.12194440e-4;
    float high_powers = 1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0 + r * (1.0 / 5040.0)));
    e = r * (1.0 + r * (0.5 + r * (1.0 / 6.0 + r * high_powers)));
    power = uintBitsToFloat((floatBitsToUint(biased) << 23) + 0x3f800000u);
}

// 2^-100 and less counts as 0: denormal numbers cost hundreds of cycles each on CPUs, and nobody sees such a lobe.
const float EXP_UNDERFLOW = -69.0;

// exp(x) for x <= 0, within 2 ulp.
float exp_negative(float x)
{
    float power, e;
    exp_parts(max(x, EXP_UNDERFLOW), power, e);
    return x < EXP_UNDERFLOW ? 0.0 : power + power * e;
}

// 1 - exp(x) for x <= 0, within 2.5 ulp, also near 0.
float one_minus_exp(float x)
{
    float power, e;
    exp_parts(max(x, EXP_UNDERFLOW), power, e);
    return (1.0 - power) - power * e;
}

// Mean of R, G and B: positive whenever one of them is, which a luminance rounded to float need not be.
float mean(vec3 colour)
{
    return (colour.r + colour.g + colour.b) * (1.0 / 3.0);
}

#endif
