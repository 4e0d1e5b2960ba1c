// Quotients of exact sums and counts, with the bits of shaders/quotient.h, but faster.
#pragma once

#include "shaders/quotient.h"

#include <cstdint>

namespace pt {

__extension__ using WideSum = unsigned __int128;

// a, b: samples of two parts. Sums are in units of 2^exponent.
class PartQuotients {
public:
    PartQuotients(std::uint32_t a, std::uint32_t b, int exponent);

    bool are_of(std::uint32_t a, std::uint32_t b) const { return a == a_ && b == b_; }

    // The mean of all samples, rounded once to nearest; 0 without samples.
    float mean(WideSum sum_a, WideSum sum_b) const { return mean_of(sum_a + sum_b, a_ + b_, factor_); }

    // Requires samples in both parts. standard_error: of the mean, derived at gpu::ErrorDivisor.
    struct Difference {
        float standard_error;
        float lesser; // of the parts' means
    };
    Difference difference(WideSum sum_a, WideSum sum_b) const;

private:
    float mean_of(WideSum sum, std::uint32_t count, double factor) const;

    std::uint32_t a_;
    std::uint32_t b_;
    int exponent_;
    gpu::ErrorDivisor divisor_{1, 0};
    double factor_; // from sums to means, in double
    double factor_a_;
    double factor_b_;
    double factor_of_error_;
};

} // namespace pt
