// The distance between an image and a reference: MSE, relative MSE, and what the reference's own noise adds.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace cli {

struct ImageError {
    double mse = 0.0; // mean of (x - r)^2 over pixels and channels
    double relative_mse =
        0.0; // mean of (x - r)^2 / (r^2 + 0.01): a dark pixel's error counts as much as a bright one's
};

// Equally many values, at least one.
ImageError image_error(std::span<const float> image, std::span<const float> reference);

// The error of `whole`, the mean of `count` samples, estimated from it and from `first`, the mean of the first
// `first_count` of them, 0 < first_count < count.
ImageError noise_of_halves(std::span<const float> first, std::uint32_t first_count, std::span<const float> whole,
                           std::uint32_t count);

// Exponent p of error ~ N^p between two sample counts; nothing where an error is 0.
std::optional<double> convergence_slope(double error_before, double count_before, double error, double count);

// 1 / (error * seconds): twice as efficient reaches the same error in half the time, if the error falls with 1 / N.
std::optional<double> efficiency(double relative_mse, double seconds);

// Of a non-empty list; the mean of the two in the middle if their number is even.
double median(std::span<const double> values);

} // namespace cli
