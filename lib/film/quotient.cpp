#include "lib/film/quotient.h"

#include <bit>
#include <cmath>

namespace pt {

namespace {

gpu::uvec4 words_of(WideSum sum) {
    return {static_cast<std::uint32_t>(sum), static_cast<std::uint32_t>(sum >> 32),
            static_cast<std::uint32_t>(sum >> 64), static_cast<std::uint32_t>(sum >> 96)};
}

} // namespace

Divisor::Divisor(std::uint32_t divisor, int exponent) :
    normal_(std::uint64_t{divisor} << std::countl_zero(divisor)),
    reciprocal_(divisor == 0 ? 0 : UINT64_MAX / normal_),
    factor_(std::ldexp(1.0, exponent + std::countl_zero(divisor))) {}

// Rounds to odd with at least 32 bits. Rounding the result to float then gives the nearest float (Boldo and Melquiond
// 2008, Emulation of a FMA and correctly rounded sums).
float Divisor::quotient(WideSum dividend) const {
    if (dividend == 0 || normal_ == 0)
        return 0.0F;
    const auto high = static_cast<std::uint64_t>(dividend >> 64);
    const auto low = static_cast<std::uint64_t>(dividend);
    const std::uint64_t upper = high != 0 ? high : low;
    const std::uint64_t lower = high != 0 ? low : 0;
    const int zeros = std::countl_zero(upper);
    const std::uint64_t leading = upper << zeros | lower >> 1 >> (63 - zeros);
    const auto estimate = static_cast<std::uint64_t>(WideSum{leading} * reciprocal_ >> 64); // may be 1 too small
    const std::uint64_t quotient = estimate + (leading - estimate * normal_ >= normal_ ? 1 : 0);
    const std::uint64_t rest = (leading - quotient * normal_) | lower << zeros;
    const auto odd_if_inexact = static_cast<std::int64_t>(quotient | (rest != 0 ? 1 : 0));
    const int exponent = (high != 0 ? 64 : 0) - zeros;
    const auto power = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
    return static_cast<float>(static_cast<double>(odd_if_inexact) * power * factor_);
}

PartQuotients::PartQuotients(std::uint32_t a, std::uint32_t b, int exponent) :
    a_(a),
    b_(b),
    exponent_(exponent),
    of_all_(a + b, exponent),
    of_a_(a, exponent),
    of_b_(b, exponent) {
    if (a > 0 && b > 0)
        error_divisor_ = gpu::error_divisor(a, b);
    of_error_ = Divisor(error_divisor_.divisor, exponent + error_divisor_.exponent);
}

// Products of sums below 2^96 have at most 128 bits.
PartQuotients::Difference PartQuotients::difference(WideSum sum_a, WideSum sum_b) const {
    bool first_is_less = false;
    float error = 0.0F;
    if ((sum_a | sum_b) >> 96 == 0) {
        const WideSum product_a = sum_a * b_;
        const WideSum product_b = sum_b * a_;
        first_is_less = product_a < product_b;
        error = of_error_.quotient(first_is_less ? product_b - product_a : product_a - product_b);
    } else {
        const gpu::WholeNumber numerator =
            gpu::weighted_difference(words_of(sum_a), a_, words_of(sum_b), b_, first_is_less);
        error = std::bit_cast<float>(gpu::standard_error_bits(numerator, error_divisor_, exponent_));
    }
    return {error, first_is_less ? of_a_.quotient(sum_a) : of_b_.quotient(sum_b)};
}

} // namespace pt
