#include "cli/compare/image_difference.h"

#include <algorithm>
#include <cmath>

namespace cli {
namespace {

using Values = std::span<const float>;

// Keeps black pixels from counting without bound.
constexpr double relative_offset = 0.01;

bool is_finite(Values pixel) {
    return std::all_of(pixel.begin(), pixel.end(), [](float value) { return std::isfinite(value); });
}

} // namespace

ImageDifference compare_images(Values image, Values reference) {
    ImageDifference total{};
    for (std::size_t i = 0; i < image.size(); i += 3) {
        if (!is_finite(image.subspan(i, 3)) || !is_finite(reference.subspan(i, 3))) {
            ++total.not_finite;
            continue;
        }
        for (std::size_t value = i; value < i + 3; ++value) {
            const double expected = reference[value];
            const double difference = std::abs(image[value] - expected);
            total.mse += difference * difference;
            total.relative_mse += difference * difference / (expected * expected + relative_offset);
            if (difference > total.maximum) {
                total.maximum = difference;
                total.maximum_value = value;
            }
        }
    }
    const std::size_t value_count = image.size() - 3 * total.not_finite;
    if (value_count > 0) {
        total.mse /= static_cast<double>(value_count);
        total.relative_mse /= static_cast<double>(value_count);
    }
    return total;
}

} // namespace cli
