#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

namespace statistics {

// Returns z with P(N(0, 1) > z) = probability.
inline double normal_quantile(double probability) {
    double low = 0.0;
    double high = 40.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (0.5 * std::erfc(middle / std::numbers::sqrt2) > probability ? low : high) = middle;
    }
    return low;
}

// Returns a nearly standard normal deviate: the cube root of chi^2 / k is nearly normal with mean 1 - 2 / (9 k) and
// variance 2 / (9 k) (Wilson and Hilferty 1931). Expected counts must be at least 10.
inline double chi_square_deviate(std::span<const double> observed, std::span<const double> expected) {
    double chi_square = 0.0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        if (!(expected[i] >= 10.0))
            throw std::invalid_argument("chi-square with fewer than 10 expected in a cell");
        const double difference = observed[i] - expected[i];
        chi_square += difference * difference / expected[i];
    }
    const double degrees = static_cast<double>(observed.size() - 1);
    const double spread = 2.0 / (9.0 * degrees);
    return (std::cbrt(chi_square / degrees) - (1.0 - spread)) / std::sqrt(spread);
}

struct Moments {
    double mean;
    double variance;
};

inline Moments moments(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value;
    const double count = static_cast<double>(values.size());
    const double mean = sum / count;
    double squares = 0.0;
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    return {mean, squares / (count - 1.0)};
}

} // namespace statistics
