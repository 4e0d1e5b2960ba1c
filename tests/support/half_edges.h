#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

constexpr std::uint32_t half_infinity = 0x7c00;

// For infinity, returns the number after the largest finite one.
inline float float_of_half(std::uint32_t bits) {
    const std::uint32_t exponent = bits >> 10;
    const std::uint32_t fraction = bits & 0x3ff;
    const std::uint32_t mantissa = exponent > 0 ? fraction + 0x400 : fraction;
    return std::ldexp(static_cast<float>(mantissa), static_cast<int>(std::max(exponent, 1U)) - 25);
}

inline float middle_above_half(std::uint32_t bits) {
    return (float_of_half(bits) + float_of_half(bits + 1)) / 2;
}
