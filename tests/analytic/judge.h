#pragma once

#include "tests/support/batch_fixture.h"

#include <cmath>
#include <cstdint>

namespace analytic {

// The probability of a false alarm over all pixels, for tabulated_bound() and batch_bound() together.
inline constexpr double false_alarms = 1e-6;
inline constexpr double tabulated_pixels = 147;
inline constexpr double false_alarm_per_judgement = false_alarms / (2.0 * tabulated_pixels);

struct Exact {
    double radiance;
    double relative_std;
};

// An upper bound for 50 operations with an error of 2^-24 = 6e-8 each.
inline constexpr double rounding = 3e-6;

// Bounds the relative error of a mean of skewed samples by Bernstein's inequality (noise_bound() in
// cli/selftest/selftest_scenes.cpp).
inline double noise_bound(double relative_std, std::uint32_t sample_count) {
    const double n = sample_count;
    const double log_probability = std::log(2.0 / false_alarm_per_judgement);
    const double variance = relative_std * relative_std;
    const double linear = log_probability * (variance + 6.0 * relative_std) / 3.0;
    return (linear + std::sqrt(linear * linear + 2.0 * n * variance * log_probability)) / n;
}

// The bound uses the known noise, so light that no sample has found cannot mislead it. Black pixels must be exactly
// black.
inline double tabulated_bound(const Exact &exact, std::uint32_t sample_count) {
    return (rounding + noise_bound(exact.relative_std, sample_count)) * exact.radiance;
}

// The bound uses the noise measured over batches, which is smaller with stratified samples.
inline double batch_bound(const Estimate &measured, const Exact &exact, std::uint32_t batch_count) {
    return rounding * exact.radiance + student_bound(false_alarm_per_judgement, batch_count) * measured.standard_error;
}

} // namespace analytic
