#include "lib/render/missed_lamps.h"

#include "lib/scene/lamp_share.h"

#include <pt/stats.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pt {

bool may_miss_lamps(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings,
                    std::uint64_t samples) {
    constexpr double enough_meetings = 1000.0; // calibrated (shaders/README.md, section 11)
    if (!finds_lamps_by_chance(settings.estimator, settings.max_path_length))
        return false;
    const std::optional<double> share = smallest_lamp_share(scene.lamps(), scene.scene.materials, camera);
    return share && static_cast<double>(samples) * *share < enough_meetings;
}

void take_in_unmet_lamps(ErrorEstimate &error, const UnmetSquares &unmet) {
    const auto exceeds = [](double root, Interval &interval) {
        constexpr double uncertain_factor = 2.0;
        if (root <= interval.estimate)
            return false;
        interval.estimate = root;
        interval.high = std::max(interval.high, uncertain_factor * root);
        return true;
    };
    const bool exceeds_rmse = exceeds(std::sqrt(unmet.square), error.rmse);
    if (exceeds(std::sqrt(unmet.relative_square), error.relative_rmse) || exceeds_rmse)
        error.uncertain |= PT_UNCERTAIN_UNMET;
}

} // namespace pt
