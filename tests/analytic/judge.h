// Compares means of samples with exact values.
#pragma once

#include "tests/support/batch_fixture.h"

#include <cmath>
#include <cstdint>

namespace analytic {

// One false alarm in a million over all pixels and both judges.
inline constexpr double false_alarms = 1e-6;
inline constexpr double tabulated_pixels = 147;
inline constexpr double false_alarm_per_judgement = false_alarms / (2.0 * tabulated_pixels);

struct Exact {
    double radiance;
    double relative_std;
};

// Up to 50 operations of 2^-24 = 6e-8.
inline constexpr double rounding = 3e-6;

// Bernstein's inequality (Boucheron, Lugosi and Massart, Concentration Inequalities, 2013, section 2.8) bounds the
// relative error of a mean of few skewed samples of variance s^2, deviations up to m: P(|error| > t) <= 2 exp(-n t^2 /
// (2 s^2 + 2 m t / 3)), solved for t. Samples that are nonzero with probability p: s^2 = (1 - p) / p, deviations s^2 up
// and 1 down. m = s^2 + 6 s holds up to p = 0.97.
inline double noise_bound(double relative_std, std::uint32_t sample_count,
                          double false_alarm = false_alarm_per_judgement) {
    const double n = sample_count;
    const double log_probability = std::log(2.0 / false_alarm);
    const double variance = relative_std * relative_std;
    const double linear = log_probability * (variance + 6.0 * relative_std) / 3.0;
    return (linear + std::sqrt(linear * linear + 2.0 * n * variance * log_probability)) / n;
}

inline double error_bound(double relative_std, std::uint32_t sample_count) {
    return rounding + noise_bound(relative_std, sample_count);
}

// The first judge knows the noise, so unseen light cannot deceive it. Black must be exact.
inline bool agrees(double measured, const Exact &exact, std::uint32_t sample_count) {
    return std::abs(measured - exact.radiance) <= error_bound(exact.relative_std, sample_count) * exact.radiance;
}

// The second judge measures the noise of batches, smaller with stratified samples.
inline double batch_bound(const Estimate &measured, const Exact &exact, std::uint32_t batch_count) {
    return rounding * exact.radiance + student_bound(false_alarm_per_judgement, batch_count) * measured.standard_error;
}

} // namespace analytic
