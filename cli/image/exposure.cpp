#include "cli/image/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cli {

double automatic_exposure(std::span<const float> radiance) {
    constexpr double middle_grey = 0.18;
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i + 2 < radiance.size(); i += 3) {
        const double mean = (static_cast<double>(radiance[i]) + radiance[i + 1] + radiance[i + 2]) / 3.0;
        if (mean > 0.0) {
            sum += std::log2(mean);
            ++count;
        }
    }
    const double stops = count == 0 ? 0.0 : std::log2(middle_grey) - sum / static_cast<double>(count);
    return std::clamp(std::round(100.0 * stops) / 100.0, -largest_exposure, largest_exposure);
}

} // namespace cli
