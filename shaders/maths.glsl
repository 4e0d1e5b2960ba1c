// Elementary functions with bounded errors, which Vulkan's sin, cos, log2 and pow lack (shaders/README.md, section 12).
// lib/kernel/accuracy.cpp derives the bounds.
#ifndef MATHS_GLSL
#define MATHS_GLSL

#include "specialization.h"

const float PI = 3.14159265358979;

// Random numbers are multiples of this.
const float NUMBER_STEP = 1.0 / 16777216.0;
const float LARGEST_NUMBER = 1.0 - NUMBER_STEP;

// 1.5 * 2^23. For |x| < 2^22 the low bits of x + ROUNDING_BIAS are round(x).
const float ROUNDING_BIAS = 12582912.0;

// min() and max() if one argument is >= 0. Bits then have the same order as numbers, and lavapipe compares them faster.
float at_most(float number, float limit)
{
    if (INTEGER_ORDER == 0u)
        return min(number, limit);
    return intBitsToFloat(min(floatBitsToInt(number), floatBitsToInt(limit)));
}

float at_least(float number, float limit)
{
    if (INTEGER_ORDER == 0u)
        return max(number, limit);
    return intBitsToFloat(max(floatBitsToInt(number), floatBitsToInt(limit)));
}

// Components must be >= 0.
float strongest_of(vec3 color) { return at_least(color.r, at_least(color.g, color.b)); }

// max() for arguments <= 0, whose bits are in reverse order.
float nearer_to_zero(float a, float b)
{
    if (INTEGER_ORDER == 0u)
        return max(a, b);
    return uintBitsToFloat(min(floatBitsToUint(a), floatBitsToUint(b)));
}

// Sine and cosine of 2 pi u for u in [0, 1], within 4.5 ulp, also near zeros. With m = min(u, 1 - u) and w = m - 1/4,
// cos(2 pi u) = -sin(2 pi w) = w p(w^2) and sin(2 pi u) = +-cos(2 pi w) = (1/2 - u) m q(w^2). p and q are minimax
// polynomials (Remez 1934) with relative errors of 5.3e-9 and 1.0e-9.
void sin_cos_turn(float u, out float sine, out float cosine)
{
    float m = at_most(u, 1.0 - u);
    float w = m - 0.25;
    float z = w * w;
    cosine = w * (-6.28318527 + z * (41.3416775 + z * (-81.6022312 + z * (76.5749922 + z * -39.7109180))));
    sine = (0.5 - u) * m * (16.0 + z * (-59.8273288 + z * (81.7913450 + z * (-58.5570666 + z * 24.7337946))));
}

// log2(1 - y) for y in [0, 1), within 18 ulp. For y < 1/4 a polynomial has a relative error of 8e-9.
float log2_one_minus(float y)
{
    float tail =
        0.721347474 + y * (0.480911545 + y * (0.360072084 + y * (0.298413979 + y * (0.169300488 + y * 0.425835469))));
    return y < 0.25 ? -y * (1.44269504 + y * tail) : log2(1.0 - y);
}

// Below this x, 2^x is replaced by 0, because denormal numbers are slow on CPUs.
const float EXP2_UNDERFLOW = -100.0;

// 2^x for x <= 0, within 3 * 2^-23.
float exp2_negative(float x)
{
    return x < EXP2_UNDERFLOW ? 0.0 : exp2(x);
}

// 1 - 2^x for x <= 0, within 2.5 ulp, also near 0. Let k be the integer nearest to x; r = x - k is exact. Then 2^x =
// 2^k (1 + e) with e = 2^r - 1, and e / r is a polynomial with a relative error of 1.1e-8.
float one_minus_exp2(float x)
{
    x = nearer_to_zero(x, EXP2_UNDERFLOW);
    precise float biased = x + ROUNDING_BIAS;
    precise float r = x - (biased - ROUNDING_BIAS);
    float high_powers = 0.0555035743 + r * (0.00961823749 + r * (0.00133907355 + r * 0.000154035124));
    float e = r * (0.693147188 + r * (0.240226498 + r * high_powers));
    float power = uintBitsToFloat((floatBitsToUint(biased) << 23) + 0x3f800000u);
    return (1.0 - power) - power * e;
}

// Unlike a rounded luminance, the mean is positive if any component is.
float mean(vec3 color)
{
    return (color.r + color.g + color.b) * (1.0 / 3.0);
}

#endif
