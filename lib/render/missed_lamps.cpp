#include "lib/render/missed_lamps.h"

#include "lib/scene/lamp_share.h"

#include <pt/stats.h>

#include <algorithm>
#include <cmath>

namespace pt {

namespace {

// Roughly the share of directions that the narrowest lobe covers, for estimators that find lobes by chance: of n + 1
// uniform directions over a hemisphere, one lies within the half-width of a lobe of glossiness n around the mirror
// direction.
double smallest_lobe_share(const PreparedScene &scene, std::uint32_t estimator) {
    double share = 1.0;
    if (estimator == PT_ESTIMATOR_UNIFORM || estimator == PT_ESTIMATOR_COSINE)
        for (const Material &material : scene.used_materials)
            if (is_glossy(material))
                share = std::min(share, 1.0 / (1.0 + material.glossiness));
    return share;
}

} // namespace

bool may_miss_lamps(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings,
                    std::uint64_t samples) {
    constexpr double enough_meetings = 1000.0; // calibrated (shaders/README.md, section 11)
    if (!finds_lamps_by_chance(settings.estimator, settings.max_path_length))
        return false;
    const double lamp_share = smallest_lamp_share(scene.lamps(), scene.scene.materials, camera).value_or(1.0);
    const double share = std::min(lamp_share, smallest_lobe_share(scene, settings.estimator));
    return static_cast<double>(samples) * share < enough_meetings;
}

void take_in_unmet_lamps(ErrorEstimate &error, const UnmetSquares &unmet) {
    const auto exceeds = [](double root, Interval &interval) {
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
