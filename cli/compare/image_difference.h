// How two images differ: numbers for all pixels together, and for each of them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace cli {

struct ImageDifference {
    // Means over the channels of the pixels that are finite in both images; 0 if there are none.
    double mse;
    double relative_mse; // of (x - r)^2 / (r^2 + 0.01) for a value x and the reference's r

    // The largest |x - r| of these.
    double maximum;
    std::size_t maximum_value; // where it is: an index into the values

    std::size_t not_finite; // pixels with a channel that is not finite in either image
};

// Equally many values, three to a pixel.
ImageDifference compare_images(std::span<const float> image, std::span<const float> reference);

// Of each pixel, the root of its relative MSE; NaN where it is not finite in either image.
std::vector<float> pixel_differences(std::span<const float> image, std::span<const float> reference);

} // namespace cli
