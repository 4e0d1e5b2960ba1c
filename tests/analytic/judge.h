// Judges whether the mean of samples agrees with an exact value. Used by the tests against exact values.
#pragma once

#include "tests/support/batch_fixture.h"

#include <cmath>
#include <cstdint>

namespace analytic {

// One false alarm in a million over all tabulated pixels and both of the judges below: each has its share.
inline constexpr double false_alarms = 1e-6;
inline constexpr double tabulated_pixels = 147;
inline constexpr double false_alarm_per_judgement = false_alarms / (2.0 * tabulated_pixels);

// An exact value, and the standard deviation of one sample as a multiple of it.
struct Exact {
    double radiance;
    double relative_std;
};

// A sample is the product of at most some 50 operations of float32, each off by up to 2^-24 = 6e-8: 50 * 6e-8.
inline constexpr double rounding = 3e-6;

// How far the mean of samples may be off, as a multiple of the exact value, with a probability of a false alarm:
// Bernstein's inequality (Boucheron, Lugosi and Massart, Concentration Inequalities, 2013, section 2.8), which holds
// for skewed samples and few of them, where multiples of the standard error do not. For n independent samples of
// variance s^2 and deviations up to m it is
//     P(|error| > t) <= 2 exp(-n t^2 / (2 s^2 + 2 m t / 3)).
// Solved for t. A sample that is 0 or one other value, of which it is the other value with probability p, has s^2 = (1
// - p) / p and deviates by s^2 upwards and 1 downwards: m = s^2 + 6 s holds for all p up to 0.97, and leaves smooth
// integrands six standard deviations. Samples of the default sampler are stratified: not independent, but less noisy.
inline double noise_bound(double relative_std, std::uint32_t sample_count,
                          double false_alarm = false_alarm_per_judgement) {
    const double n = sample_count;
    const double log_probability = std::log(2.0 / false_alarm);
    const double variance = relative_std * relative_std;
    const double linear = log_probability * (variance + 6.0 * relative_std) / 3.0;
    return (linear + std::sqrt(linear * linear + 2.0 * n * variance * log_probability)) / n;
}

// The same with the rounding of float32.
inline double error_bound(double relative_std, std::uint32_t sample_count) {
    return rounding + noise_bound(relative_std, sample_count);
}

// The first judge knows the noise of a sample beforehand, so that light which no sample found cannot deceive it. A
// pixel that is exactly black must be exactly that.
inline bool agrees(double measured, const Exact &exact, std::uint32_t sample_count) {
    return std::abs(measured - exact.radiance) <= error_bound(exact.relative_std, sample_count) * exact.radiance;
}

// The second measures the noise, from batches with different seeds: it sees smaller errors, as stratified samples have
// less noise.
inline double batch_bound(const Estimate &measured, const Exact &exact, std::uint32_t batch_count) {
    return rounding * exact.radiance + student_bound(false_alarm_per_judgement, batch_count) * measured.standard_error;
}

} // namespace analytic
