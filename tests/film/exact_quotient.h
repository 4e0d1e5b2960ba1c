#pragma once

#include "lib/film/quotient.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

inline int compare_shifted(pt::WideSum a, int shift, pt::WideSum b) {
    if (shift < 0)
        return -compare_shifted(b, -shift, a);
    const int room = a >> 64 != 0 ? std::countl_zero(static_cast<std::uint64_t>(a >> 64))
                                  : 64 + std::countl_zero(static_cast<std::uint64_t>(a));
    if (a == 0)
        return b == 0 ? 0 : -1;
    if (shift > room)
        return 1;
    const pt::WideSum shifted = a << shift;
    return shifted < b ? -1 : shifted > b ? 1 : 0;
}

struct Middle {
    pt::WideSum mantissa;
    int exponent;
};

inline Middle middle_above(std::uint32_t float_bits) {
    const std::uint32_t exponent = float_bits >> 23;
    const std::uint32_t fraction = float_bits & 0x7fffff;
    const std::uint32_t mantissa = exponent > 0 ? fraction + 0x800000 : fraction;
    return {2 * pt::WideSum{mantissa} + 1, static_cast<int>(std::max(exponent, 1U)) - 127 - 23 - 1};
}

// Whether the float is nearest to sum * 2^exponent / count. Ties go to even mantissas.
inline bool is_nearest(std::uint32_t bits, pt::WideSum sum, std::uint32_t count, int exponent) {
    const bool even = bits % 2 == 0;
    if (bits < 0x7f800000) { // Infinity has no upper midpoint.
        const Middle above = middle_above(bits);
        const int order = compare_shifted(above.mantissa * count, above.exponent - exponent, sum);
        if (order < 0 || (order == 0 && !even))
            return false;
    }
    if (bits == 0)
        return true;
    const Middle below = middle_above(bits - 1);
    const int order = compare_shifted(below.mantissa * count, below.exponent - exponent, sum);
    return order < 0 || (order == 0 && even);
}

// Returns |A b - B a| 2^exponent / ((a + b) sqrt(a b)). The numerator is exact.
inline long double exact_standard_error(pt::WideSum sum_a, std::uint32_t a, pt::WideSum sum_b, std::uint32_t b,
                                        int exponent) {
    const auto multiplied = [](pt::WideSum sum, std::uint32_t factor) {
        const pt::WideSum low = pt::WideSum{static_cast<std::uint64_t>(sum)} * factor;
        const pt::WideSum high = (sum >> 64) * factor + (low >> 64);
        return std::pair(high, static_cast<std::uint64_t>(low));
    };
    auto larger = multiplied(sum_a, b);
    auto smaller = multiplied(sum_b, a);
    if (larger < smaller)
        std::swap(larger, smaller);
    const pt::WideSum high = larger.first - smaller.first - (larger.second < smaller.second ? 1 : 0);
    const std::uint64_t low = larger.second - smaller.second;
    const long double numerator =
        high >> 64 != 0 ? std::ldexp(static_cast<long double>(high), 64) : static_cast<long double>(high << 64 | low);
    const long double sum = static_cast<long double>(a) + b;
    return std::ldexp(numerator / sum / std::sqrt(static_cast<long double>(a) * b), exponent);
}

// Whether `found` is within .52 ulp of `exact`.
inline bool is_close(float found, long double exact) {
    if (std::isinf(found))
        return exact >= 0x1.ffffffp127L;
    const long double last_place = std::ldexp(1.0L, std::max(std::ilogb(exact == 0 ? 1e-40L : exact), -126) - 23);
    return std::abs(static_cast<long double>(found) - exact) <= 0.52L * last_place;
}
