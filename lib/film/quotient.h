// Divides exact sums by sample counts. The bits are the same as in shaders/quotient.h, but 64-bit products are faster.
#pragma once

#include "shaders/quotient.h"

#include <cstdint>

namespace pt {

__extension__ using WideSum = unsigned __int128;

class Divisor {
public:
    Divisor(std::uint32_t divisor, int exponent);

    // Rounds once to nearest. Returns 0 if the divisor is 0.
    float quotient(WideSum dividend) const;

private:
    std::uint64_t normal_;     // the divisor times a power of two, in [2^31, 2^32)
    std::uint64_t reciprocal_; // 2^64 / normal_; may be 1 too small
    double factor_;
};

// The two parts have a and b samples. Sums are in units of 2^exponent.
class PartQuotients {
public:
    PartQuotients(std::uint32_t a, std::uint32_t b, int exponent);

    bool are_of(std::uint32_t a, std::uint32_t b) const { return a == a_ && b == b_; }

    float mean(WideSum sum_a, WideSum sum_b) const { return of_all_.quotient(sum_a + sum_b); }

    // Both parts must have samples. gpu::ErrorDivisor explains the standard error.
    struct Difference {
        float standard_error;
        float lesser;
    };
    Difference difference(WideSum sum_a, WideSum sum_b) const;

private:
    std::uint32_t a_;
    std::uint32_t b_;
    int exponent_;
    Divisor of_all_;
    Divisor of_a_;
    Divisor of_b_;
    gpu::ErrorDivisor error_divisor_{1, 0};
    Divisor of_error_{1, 0};
};

} // namespace pt
