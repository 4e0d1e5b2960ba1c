#include "lib/render/missed_lamps.h"

#include "lib/film/error_estimate.h"
#include "lib/scene/lamp_share.h"

#include <optional>

namespace pt {

bool may_miss_lamps(const Scene &scene, const Camera &camera, const RenderSettings &settings, std::uint64_t samples) {
    constexpr double enough_meetings = 1000.0; // calibrated (shaders/README.md, section 11)
    if (!finds_lamps_by_chance(settings.estimator, settings.max_path_length))
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
