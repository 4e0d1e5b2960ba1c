// Quotients of exact sums and counts, as the kernels compute them (shaders/quotient.glsl, film_mean.glsl): the same
// bits.
#pragma once

#include <cstdint>

namespace pt {

// Sums of samples, as whole numbers.
__extension__ using WideSum = unsigned __int128;

// sum * 2^exponent / count, rounded once, to nearest; 0 of no sample.
float mean_of(WideSum sum, std::uint32_t count, int exponent);

// What the sums of two parts of samples show, each of one sample at least.
struct PartDifference {
    float standard_error; // of the mean of all
    bool first_is_less;   // the mean of the first part is below that of the second
};

// Of sums A and B of a and b samples: |A / a - B / b| sqrt(a b) / (a + b), times 2^exponent, within .52 of the last
// place.
//
// Of a + b samples, whose means are those of the first a and the other b: if every sample has the variance v, the
// square of the difference of the means has the expectation v / a + v / b, and the mean of all has the variance
// v / (a + b): that square times a b / (a + b)^2.
class PartWeights {
public:
    // One sample at least in each.
    PartWeights(std::uint32_t a, std::uint32_t b);

    bool are_of(std::uint32_t a, std::uint32_t b) const { return a == a_ && b == b_; }
    PartDifference difference(WideSum sum_a, WideSum sum_b, int exponent) const;

    // What difference() multiplies |A b - B a| with, but for the power of two: within 2^-53 of itself.
    double scale() const;

private:
    std::uint32_t a_;
    std::uint32_t b_;
    std::uint32_t divisor_; // (a + b) sqrt(a b), times a power of two
    int exponent_;          // of what the quotient is to be multiplied with for that
};

} // namespace pt
