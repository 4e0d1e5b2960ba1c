#include "lib/render/missed_lamps.h"

#include "lib/scene/lamp_share.h"

#include <pt/pt.h>

#include <optional>

namespace pt {

bool may_miss_lamps(const Scene &scene, const Camera &camera, const RenderSettings &settings, std::uint64_t samples) {
    constexpr double enough_meetings = 1000.0; // calibrated (shaders/README.md, section 11)
    const std::uint32_t estimator = settings.estimator;
    const bool by_chance =
        settings.max_path_length > 1 &&
        (estimator == PT_ESTIMATOR_UNIFORM || estimator == PT_ESTIMATOR_COSINE || estimator == PT_ESTIMATOR_BSDF);
    if (!by_chance)
        return false;
    const std::optional<double> share = smallest_lamp_share(scene, camera);
    return share && static_cast<double>(samples) * *share < enough_meetings;
}

bool may_miss_lamps_in_view(const Scene &scene, const Camera &camera, const RenderSettings &settings,
                            std::uint64_t samples) {
    constexpr double enough_meetings = 8.0; // of which a root is off by a third: calibrated
    const std::optional<double> pixels =
        pixels_of_smallest_lamp_in_view(scene, camera, settings.width, settings.height);
    return pixels && static_cast<double>(samples) * *pixels < enough_meetings;
}

} // namespace pt
