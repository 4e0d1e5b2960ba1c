#include "lib/film/quotient.h"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace pt {

namespace {

gpu::uvec4 words_of(WideSum sum) {
    return {static_cast<std::uint32_t>(sum), static_cast<std::uint32_t>(sum >> 32),
            static_cast<std::uint32_t>(sum >> 64), static_cast<std::uint32_t>(sum >> 96)};
}

// As a double; the exponent must be within its range.
double power_of_two(int exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

// The float to which every number within 2^-50 of this one, relatively, is rounded; nothing if they are not rounded
// alike, which is rare (Ziv 1991, Fast evaluation of elementary mathematical functions with correctly rounded last
// bit).
std::optional<float> rounded_alike(double approximate) {
    constexpr std::uint64_t tie = std::uint64_t{1} << 28; // of the 29 bits that a float does not have
    const std::uint64_t below_float = std::bit_cast<std::uint64_t>(approximate) % (2 * tie);
    const bool decided = below_float + 8 < tie || below_float > tie + 8;
    if (decided && approximate >= 0x1p-126 && approximate < 0x1p127)
        return static_cast<float>(approximate);
    return std::nullopt;
}

// Off by at most a 2^52th of itself: the upper half is rounded, and so is the sum of the two halves.
double nearly(WideSum number) {
    return static_cast<double>(static_cast<std::uint64_t>(number >> 64)) * 0x1p64 +
           static_cast<double>(static_cast<std::uint64_t>(number));
}

} // namespace

// Tries double precision first, with three roundings.
float mean_of(WideSum sum, std::uint32_t count, int exponent) {
    if (sum == 0 || count == 0)
        return 0.0F;
    if (const std::optional<float> mean = rounded_alike(nearly(sum) / count * power_of_two(exponent)))
        return *mean;
    return std::bit_cast<float>(gpu::mean_bits(words_of(sum), count, exponent));
}

double PartWeights::scale() const {
    return power_of_two(divisor_.exponent) / divisor_.divisor;
}

// For sums below 2^96 the products have 128 bits, and double mostly suffices for the quotient; powers of two beyond
// double are left to whole numbers.
PartDifference PartWeights::difference(WideSum sum_a, WideSum sum_b, int exponent) const {
    const int exponent_of_quotient = exponent + divisor_.exponent;
    if ((sum_a | sum_b) >> 96 == 0 && std::abs(exponent_of_quotient) <= 1022) {
        const WideSum product_a = sum_a * b_;
        const WideSum product_b = sum_b * a_;
        const bool first_is_less = product_a < product_b;
        const WideSum numerator = first_is_less ? product_b - product_a : product_a - product_b;
        if (numerator == 0)
            return {0.0F, false};
        const double quotient = nearly(numerator) / divisor_.divisor * power_of_two(exponent_of_quotient);
        if (const auto error = rounded_alike(quotient))
            return {*error, first_is_less};
    }
    bool first_is_less = false;
    const gpu::WholeNumber numerator =
        gpu::weighted_difference(words_of(sum_a), a_, words_of(sum_b), b_, first_is_less);
    return {std::bit_cast<float>(gpu::standard_error_bits(numerator, divisor_, exponent)), first_is_less};
}

} // namespace pt
