// Quotients of exact sums and counts, as the kernels compute them (shaders/quotient.h): the same bits, sooner.
#pragma once

#include "shaders/quotient.h"

#include <cstdint>

namespace pt {

// Sums of samples, as whole numbers.
__extension__ using WideSum = unsigned __int128;

// sum * 2^exponent / count, rounded once, to nearest; 0 without samples.
float mean_of(WideSum sum, std::uint32_t count, int exponent);

// What the sums of two parts say, each with at least one sample.
struct PartDifference {
    float standard_error; // of the mean of all
    bool first_is_less;   // the mean of the first part is below that of the second
};

// For sums of a and b samples: the standard error that gpu::ErrorDivisor derives, times 2^exponent.
class PartWeights {
public:
    // Both parts have at least one sample.
    PartWeights(std::uint32_t a, std::uint32_t b) : a_(a), b_(b), divisor_(gpu::error_divisor(a, b)) {}

    bool are_of(std::uint32_t a, std::uint32_t b) const { return a == a_ && b == b_; }
    PartDifference difference(WideSum sum_a, WideSum sum_b, int exponent) const;

    // The factor of |A b - B a| in difference(), without its power of two: within 2^-53 of itself.
    double scale() const;

private:
    std::uint32_t a_;
    std::uint32_t b_;
    gpu::ErrorDivisor divisor_;
};

} // namespace pt
