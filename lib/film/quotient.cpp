#include "lib/film/quotient.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

namespace pt {

namespace {

// A whole number below 2^160.
struct Number {
    WideSum high;      // multiples of 2^32
    std::uint32_t low; // the rest

    bool operator==(const Number &) const = default;
    bool operator<(const Number &other) const { return high < other.high || (high == other.high && low < other.low); }
};

Number product(WideSum sum, std::uint32_t count) {
    const WideSum low = (sum & UINT32_MAX) * count;
    return {(sum >> 32) * count + (low >> 32), static_cast<std::uint32_t>(low)};
}

Number difference_of(const Number &a, const Number &b) {
    return {a.high - b.high - (a.low < b.low ? 1 : 0), a.low - b.low};
}

// The leading 64 bits of a number, the first one set: bits * 2^exponent, or more by less than 2^exponent if inexact.
struct LeadingBits {
    std::uint64_t bits;
    int exponent;
    bool inexact;
};

// For numbers that are not 0.
LeadingBits leading_bits(WideSum number) {
    const auto high = static_cast<std::uint64_t>(number >> 64);
    const auto low = static_cast<std::uint64_t>(number);
    if (high == 0) {
        const int zeros = std::countl_zero(low);
        return {low << zeros, -zeros, false};
    }
    const int zeros = std::countl_zero(high);
    return {static_cast<std::uint64_t>((number << zeros) >> 64), 64 - zeros, low << zeros != 0};
}

LeadingBits leading_bits(const Number &number) {
    if (number.high == 0)
        return leading_bits(WideSum{number.low});
    LeadingBits leading = leading_bits(number.high);
    leading.exponent += 32;
    if (leading.exponent >= 32) {
        leading.inexact = leading.inexact || number.low != 0;
        return leading;
    }
    // If the high part is short, the low one fills up: at most 63 bits are missing, and it has 32.
    const int missing = 32 - leading.exponent;
    const std::uint64_t low = std::uint64_t{number.low} << 32;
    leading.bits |= low >> (64 - missing);
    leading.inexact = low << missing != 0;
    return leading;
}

// quotient * 2^exponent, or a little more if inexact, rounded to nearest, ties to even. quotient has at least 26 bits.
float rounded(std::uint64_t quotient, int exponent, bool inexact) {
    // 26 bits are two more than a float has; those below count as "a little more".
    const int further = 63 - 25 - std::countl_zero(quotient);
    const auto leading = static_cast<std::uint32_t>(quotient >> further);
    inexact = inexact || std::uint64_t{leading} << further != quotient;
    const int magnitude = 25 + further + exponent; // the number is in [2^magnitude, 2^(magnitude + 1))
    if (magnitude > 127)
        return std::numeric_limits<float>::infinity();
    // A float with the exponent -126 or less has the last bit 2^-149.
    const int float_exponent = std::max(magnitude, -126);
    const int dropped = std::min(2 + float_exponent - magnitude, 31);
    const std::uint32_t kept = leading >> dropped;
    const std::uint32_t rest = leading & ((1U << dropped) - 1);
    const std::uint32_t half_of_last = 1U << (dropped - 1);
    const bool up = rest > half_of_last || (rest == half_of_last && (inexact || kept % 2 == 1));
    // The leading one of a normal float adds the last 1 to the exponent's bits, and so does a carry.
    return std::bit_cast<float>((static_cast<std::uint32_t>(float_exponent + 126) << 23) + kept + (up ? 1U : 0U));
}

float quotient(const LeadingBits &dividend, std::uint32_t divisor, int exponent) {
    return rounded(dividend.bits / divisor, dividend.exponent + exponent,
                   dividend.inexact || dividend.bits % divisor != 0);
}

// As a double, for exponents within its range.
double power_of_two(int exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

// The largest whole number whose square is not above a number. The root in double may be off by one.
std::uint32_t square_root(std::uint64_t square) {
    auto root = static_cast<std::uint64_t>(std::min(std::sqrt(static_cast<double>(square)), 0x1.fffffffep31));
    while (root * root > square)
        --root;
    while (root < UINT32_MAX && (root + 1) * (root + 1) <= square)
        ++root;
    return static_cast<std::uint32_t>(root);
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

// Within 2^-52 of itself: the upper half is rounded, and so is the sum of both.
double nearly(WideSum number) {
    return static_cast<double>(static_cast<std::uint64_t>(number >> 64)) * 0x1p64 +
           static_cast<double>(static_cast<std::uint64_t>(number));
}

} // namespace

// Tries double first, with three roundings.
float mean_of(WideSum sum, std::uint32_t count, int exponent) {
    if (sum == 0 || count == 0)
        return 0.0F;
    if (const std::optional<float> mean = rounded_alike(nearly(sum) / count * power_of_two(exponent)))
        return *mean;
    return quotient(leading_bits(sum), count, exponent);
}

// The root is cut to 32 bits and so is the divisor (a + b) sqrt(a b), each by less than a 2^31th.
PartWeights::PartWeights(std::uint32_t a, std::uint32_t b) : a_(a), b_(b) {
    const std::uint64_t square = std::uint64_t{a} * b;
    const int shift = std::countl_zero(square) / 2;
    const std::uint32_t root = square_root(square << (2 * shift)); // times 2^shift
    const std::uint64_t divisor = (std::uint64_t{a} + b) * root;
    const int dropped = 32 - std::countl_zero(divisor);
    divisor_ = static_cast<std::uint32_t>(divisor >> dropped);
    exponent_ = shift - dropped;
}

double PartWeights::scale() const {
    return power_of_two(exponent_) / divisor_;
}

// The numerator |A b - B a| is exact. For sums below 2^96 the products have 128 bits, and double mostly suffices for
// the quotient; powers of two beyond double are left to whole numbers.
PartDifference PartWeights::difference(WideSum sum_a, WideSum sum_b, int exponent) const {
    exponent += exponent_;
    if ((sum_a | sum_b) >> 96 == 0 && std::abs(exponent) <= 1022) {
        const WideSum product_a = sum_a * b_;
        const WideSum product_b = sum_b * a_;
        const bool first_is_less = product_a < product_b;
        const WideSum numerator = first_is_less ? product_b - product_a : product_a - product_b;
        if (numerator == 0)
            return {0.0F, false};
        if (const auto error = rounded_alike(nearly(numerator) / divisor_ * power_of_two(exponent)))
            return {*error, first_is_less};
    }
    const Number product_a = product(sum_a, b_);
    const Number product_b = product(sum_b, a_);
    if (product_a == product_b)
        return {0.0F, false};
    const bool first_is_less = product_a < product_b;
    const Number numerator = first_is_less ? difference_of(product_b, product_a) : difference_of(product_a, product_b);
    return {quotient(leading_bits(numerator), divisor_, exponent), first_is_less};
}

} // namespace pt
