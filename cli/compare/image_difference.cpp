#include "cli/compare/image_difference.h"

#include "cli/image/error_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cli {
namespace {

using Values = std::span<const float>;

bool is_finite(Values pixel) {
    return std::all_of(pixel.begin(), pixel.end(), [](float value) { return std::isfinite(value); });
}

} // namespace

ImageDifference compare_images(Values image, Values reference) {
    ImageDifference total{};
    for (std::size_t i = 0; i < image.size(); i += 3) {
        const Values pixel = image.subspan(i, 3);
        const Values wanted = reference.subspan(i, 3);
        if (!is_finite(pixel) || !is_finite(wanted)) {
            ++total.not_finite;
            continue;
        }
        const ImageError error = image_error(pixel, wanted);
        total.mse += error.mse;
        total.relative_mse += error.relative_mse;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double difference = std::abs(double{pixel[channel]} - double{wanted[channel]});
            if (difference > total.maximum) {
                total.maximum = difference;
                total.maximum_value = i + channel;
            }
        }
    }
    const std::size_t pixel_count = image.size() / 3 - total.not_finite;
    if (pixel_count > 0) {
        total.mse /= static_cast<double>(pixel_count);
        total.relative_mse /= static_cast<double>(pixel_count);
    }
    return total;
}

std::vector<float> pixel_differences(Values image, Values reference) {
    std::vector<float> differences;
    differences.reserve(image.size() / 3);
    for (std::size_t i = 0; i < image.size(); i += 3) {
        const Values pixel = image.subspan(i, 3);
        const Values wanted = reference.subspan(i, 3);
        const bool known = is_finite(pixel) && is_finite(wanted);
        differences.push_back(known ? static_cast<float>(std::sqrt(image_error(pixel, wanted).relative_mse))
                                    : std::numeric_limits<float>::quiet_NaN());
    }
    return differences;
}

} // namespace cli
