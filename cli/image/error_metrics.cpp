#include "cli/image/error_metrics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

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

// With shares a = first_count / count and 1 - a, whole = a first + (1 - a) rest. If every sample has the variance v and
// N of them are taken, E[(first - whole)^2] = v / (a N) - v / N = (v / N) (1 - a) / a, so that the wanted v / N is
// that square times a / (1 - a). For halves the factor is 1.
ImageError noise_of_halves(std::span<const float> first, std::uint32_t first_count, std::span<const float> whole,
                           std::uint32_t count) {
    const double factor = static_cast<double>(first_count) / (static_cast<double>(count) - first_count);
    const ImageError error = image_error(first, whole);
    return {error.mse * factor, error.relative_mse * factor};
}

std::optional<double> convergence_slope(double error_before, double count_before, double error, double count) {
    if (!(error_before > 0.0 && error > 0.0) || count == count_before) {
        return std::nullopt;
    }
    return std::log(error / error_before) / std::log(count / count_before);
}

std::optional<double> efficiency(double relative_mse, double seconds) {
    if (!(relative_mse > 0.0 && seconds > 0.0)) {
        return std::nullopt;
    }
    return 1.0 / (relative_mse * seconds);
}

double median(std::span<const double> values) {
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const std::size_t middle = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2.0;
}

} // namespace cli
