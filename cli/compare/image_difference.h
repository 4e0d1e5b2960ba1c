// How two images differ, in numbers.
#pragma once

#include <cstddef>
#include <span>

namespace cli {

struct ImageDifference {
    // Means over the channels of those pixels that are finite in both images; 0 if there are none.
    double mse;          // of (x - r)^2 for a value x and the reference's r
    double relative_mse; // of (x - r)^2 / (r^2 + 0.01): a dark pixel's error counts as much as a bright one's

    // The largest |x - r| among them.
    double maximum;
    std::size_t maximum_value; // where it is: an index into the values

    std::size_t not_finite; // pixels with a channel that is not finite in either image
};

// Both have the same number of values, three for each pixel.
ImageDifference compare_images(std::span<const float> image, std::span<const float> reference);

} // namespace cli
