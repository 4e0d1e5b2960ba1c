// The distance between an image and a reference: MSE and relative MSE.
#pragma once

#include <span>

namespace cli {

struct ImageError {
    double mse = 0.0; // mean of (x - r)^2 over pixels and channels
    double relative_mse =
        0.0; // mean of (x - r)^2 / (r^2 + 0.01): a dark pixel's error counts as much as a bright one's
};

// Equally many values, at least one.
ImageError image_error(std::span<const float> image, std::span<const float> reference);

} // namespace cli
