#include "lib/film/quotient.h"

#include <bit>
#include <cmath>
#include <optional>

namespace pt {

namespace {

gpu::uvec4 words_of(WideSum sum) {
    return {static_cast<std::uint32_t>(sum), static_cast<std::uint32_t>(sum >> 32),
            static_cast<std::uint32_t>(sum >> 64), static_cast<std::uint32_t>(sum >> 96)};
}

// Relative error at most 2^-52. Words make up the lower half, since converting unsigned 64-bit numbers takes an
// unpredictable branch.
double nearly(WideSum number) {
    const double lower = static_cast<double>(static_cast<std::uint32_t>(number >> 32)) * 0x1p32 +
                         static_cast<double>(static_cast<std::uint32_t>(number));
    return static_cast<double>(static_cast<std::uint64_t>(number >> 64)) * 0x1p64 + lower;
}

// The float nearest to a product; nothing if a double within a relative 2^-50 rounds to another float (Ziv 1991, Fast
// evaluation of elementary mathematical functions with correctly rounded last bit).
std::optional<float> rounded_product(WideSum number, double factor) {
    constexpr std::uint64_t tie = std::uint64_t{1} << 28; // half of the 29 bits that a float lacks
    const double product = nearly(number) * factor;
    const std::uint64_t below_float = std::bit_cast<std::uint64_t>(product) % (2 * tie);
    const bool decided = below_float + 8 < tie || below_float > tie + 8;
    if (decided && product >= 0x1p-126 && product < 0x1p127)
        return static_cast<float>(product);
    return std::nullopt;
}

// Rounded once. If the result is no normal double, its products are no normal floats.
double factor_of(std::uint32_t divisor, int exponent) {
    return std::ldexp(1.0 / divisor, exponent);
}

} // namespace

PartQuotients::PartQuotients(std::uint32_t a, std::uint32_t b, int exponent) :
    a_(a),
    b_(b),
    exponent_(exponent),
    factor_(factor_of(a + b, exponent)),
    factor_a_(factor_of(a, exponent)),
    factor_b_(factor_of(b, exponent)) {
    if (a > 0 && b > 0)
        divisor_ = gpu::error_divisor(a, b);
    factor_of_error_ = factor_of(divisor_.divisor, exponent + divisor_.exponent);
}

// Tries double precision first, with four roundings.
float PartQuotients::mean_of(WideSum sum, std::uint32_t count, double factor) const {
    if (sum == 0)
        return 0.0F;
    if (const std::optional<float> mean = rounded_product(sum, factor))
        return *mean;
    return std::bit_cast<float>(gpu::mean_bits(words_of(sum), count, exponent_));
}

// The products of sums below 2^96 have 128 bits, and double mostly suffices for the quotient.
PartQuotients::Difference PartQuotients::difference(WideSum sum_a, WideSum sum_b) const {
    bool first_is_less = false;
    std::optional<float> error;
    if ((sum_a | sum_b) >> 96 == 0) {
        const WideSum product_a = sum_a * b_;
        const WideSum product_b = sum_b * a_;
        first_is_less = product_a < product_b;
        const WideSum numerator = first_is_less ? product_b - product_a : product_a - product_b;
        error = numerator == 0 ? 0.0F : rounded_product(numerator, factor_of_error_);
    }
    if (!error) {
        const gpu::WholeNumber numerator =
            gpu::weighted_difference(words_of(sum_a), a_, words_of(sum_b), b_, first_is_less);
        error = std::bit_cast<float>(gpu::standard_error_bits(numerator, divisor_, exponent_));
    }
    return {*error, first_is_less ? mean_of(sum_a, a_, factor_a_) : mean_of(sum_b, b_, factor_b_)};
}

} // namespace pt
