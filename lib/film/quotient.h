// Quotients of exact sums and counts, as the kernels compute them (shaders/quotient.glsl, film_mean.glsl): the same
// bits.
#pragma once

#include <cstdint>

namespace pt {

// Sums of samples, as whole numbers.
__extension__ using WideSum = unsigned __int128;

// sum * 2^exponent / count, rounded once, to nearest; 0 without samples.
float mean_of(WideSum sum, std::uint32_t count, int exponent);

// What the sums of two parts show, each with at least one sample.
struct PartDifference {
    float standard_error; // of the mean of all
    bool first_is_less;   // the mean of the first part is below that of the second
};

// For sums A and B of a and b samples: |A / a - B / b| sqrt(a b) / (a + b), times 2^exponent, within .52 of the last
// place.
//
// Why: if every sample has the variance v, the squared difference of the two means has the expectation v / a + v / b,
// and the mean of all samples has the variance v / (a + b), which is that expectation times a b / (a + b)^2.
class PartWeights {
public:
    // At least one sample in each.
    PartWeights(std::uint32_t a, std::uint32_t b);

    bool are_of(std::uint32_t a, std::uint32_t b) const { return a == a_ && b == b_; }
    PartDifference difference(WideSum sum_a, WideSum sum_b, int exponent) const;

    // The factor of |A b - B a| in difference(), without its power of two: within 2^-53 of itself.
    double scale() const;

private:
    std::uint32_t a_;
    std::uint32_t b_;
    std::uint32_t divisor_; // (a + b) sqrt(a b), times a power of two
    int exponent_;          // of that power of two
};

} // namespace pt
