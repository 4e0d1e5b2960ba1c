#include "cli/image/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace cli {

double automatic_exposure(std::span<const float> radiance) {
    constexpr double middle_grey = 0.18;
    constexpr double black = 1.0 / 128.0; // of the level
    std::vector<double> means;
    for (std::size_t i = 0; i + 2 < radiance.size(); i += 3)
        if (const double mean = (static_cast<double>(radiance[i]) + radiance[i + 1] + radiance[i + 2]) / 3.0;
            mean > 0.0)
            means.push_back(mean);
    double level = std::numeric_limits<double>::infinity();
    for (int cut = 0; cut <= 3; ++cut) {
        double sum = 0.0;
        for (const double mean : means)
            sum += std::min(mean, level);
        level = sum / static_cast<double>(means.size());
    }
    double sum = 0.0;
    double weights = 0.0;
    for (const double mean : means) {
        const double weight = mean / (mean + black * level);
        sum += weight * std::log2(mean);
        weights += weight;
    }
    const double stops = means.empty() ? 0.0 : std::log2(middle_grey) - sum / weights;
    return std::clamp(std::round(100.0 * stops) / 100.0, -largest_exposure, largest_exposure);
}

} // namespace cli
