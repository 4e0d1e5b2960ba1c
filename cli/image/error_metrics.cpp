#include "cli/image/error_metrics.h"

#include <cstddef>

namespace cli {
namespace {

// Keeps black pixels from counting without bound.
constexpr double relative_offset = 0.01;

} // namespace

ImageError image_error(std::span<const float> image, std::span<const float> reference) {
    ImageError sum;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const double expected = reference[i];
        const double difference = image[i] - expected;
        sum.mse += difference * difference;
        sum.relative_mse += difference * difference / (expected * expected + relative_offset);
    }
    const auto count = static_cast<double>(image.size());
    return {sum.mse / count, sum.relative_mse / count};
}

} // namespace cli
