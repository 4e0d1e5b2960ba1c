// How two images differ: numbers for all pixels together, and for each of them, and colors that show them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cli {

// sRGB of a number, which is clamped to [0, 1]. The published table has 256 entries: every fifth is held, and between
// them colors are on straight lines, which differ from the table by 1/255 at the most.
std::array<std::uint8_t, 3> viridis(double number);

struct ImageDifference {
    // Means over the channels of those pixels that are finite in both images; 0 if there are none.
    double mse;          // of (x - r)^2 for a value x and the reference's r
    double relative_mse; // of (x - r)^2 / (r^2 + 0.01): a dark pixel's error counts as much as a bright one's

    // The largest |x - r| among them.
    double maximum;
    std::size_t maximum_value; // where it is: an index into the values

    std::size_t not_finite;    // pixels with a channel that is not finite in either image
    std::vector<float> pixels; // of each, the root of its relative MSE; NaN where it is not finite in either image
};

// Both have the same number of values, three for each pixel.
ImageDifference compare_images(std::span<const float> image, std::span<const float> reference);

} // namespace cli
