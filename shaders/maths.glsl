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

// log(1 - y) for y in [0, 1), within 13 ulp. Below 1/4 a polynomial that interpolates log(1 - y) / -y in Chebyshev's
// points, with 1 at y = 0 and less than 1e-8 of error: near 0 it keeps full precision. From there on log2, which Vulkan
// promises to 2^-21.
float log_one_minus(float y)
{
    float tail =
        0.49999997 + y * (0.33334226 + y * (0.24959032 + y * (0.20676105 + y * (0.11773734 + y * 0.29454172))));
    return y < 0.25 ? -y * (1.0 + y * tail) : 0.693147181 * log2(1.0 - y);
}

// 2^-100 and less counts as 0: denormal numbers cost hundreds of cycles each on CPUs, and nobody sees such a lobe.
const float EXP_UNDERFLOW = -69.0;

// exp(x) for x <= 0, within 4 + 5 |x| ulp, so 4 ulp of 1 at most: Vulkan promises exp2(y) to 3 + 2 |y| ulp.
float exp_negative(float x)
{
    return x < EXP_UNDERFLOW ? 0.0 : exp2(1.44269504 * x);
}

// 1 - exp(x) for x <= 0, within 2.5 ulp, also near 0. exp(x) = 2^k (1 + e) with e = exp(r) - 1, |r| <= ln(2) / 2. The
// Taylor polynomial of e is cut at r^8 / 8!, 5e-9. The two halves of ln 2 (Cody and Waite 1980) make k ln 2 exact.
float one_minus_exp(float x)
{
    x = max(x, EXP_UNDERFLOW);
    precise float biased = x * 1.44269504 + ROUNDING_BIAS;
    precise float k = biased - ROUNDING_BIAS;
    precise float r = (x - k * 0.693359375) + k * 2.12194440e-4;
    float high_powers = 1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0 + r * (1.0 / 5040.0)));
    float e = r * (1.0 + r * (0.5 + r * (1.0 / 6.0 + r * high_powers)));
    float power = uintBitsToFloat((floatBitsToUint(biased) << 23) + 0x3f800000u);
    return (1.0 - power) - power * e;
}

// Mean of R, G and B: positive whenever one of them is, which a luminance rounded to float need not be.
float mean(vec3 colour)
{
    return (colour.r + colour.g + colour.b) * (1.0 / 3.0);
}

#endif
