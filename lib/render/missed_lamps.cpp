#include "lib/render/missed_lamps.h"

#include "shaders/specialization.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace pt {

namespace {

// A fraction 1 / (n + 1) of uniform directions is within the half-width of a lobe of glossiness n.
double smallest_lobe_share(const PreparedScene &scene, std::uint32_t estimator) {
    double share = 1.0;
    if (!gpu::samples_lobes(estimator))
        for (const Material &material : scene.used_materials)
            if (is_glossy(material))
                share = std::min(share, 1.0 / (1.0 + material.glossiness));
    return share;
}

// Returns the fraction of directions that hit a sphere: (1 - cos a) / 2 = sin^2 a / (2 (1 + cos a)), which avoids
// cancellation.
double share_of(const MovingBall &ball, double distance) {
    const double sine = ball.radius / distance;
    const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
    return sine * sine / (2.0 * (1.0 + cosine));
}

} // namespace

double smallest_lamp_share(std::span<const Lamp> lamps) {
    constexpr double least_light = 0.01;
    std::vector<std::pair<double, double>> shares;
    double all_light = 0.0;
    for (const Lamp &lamp : lamps) {
        const double distance = glm::length(lamp.bound.open);
        if (distance <= lamp.bound.radius)
            continue;
        const double share = share_of(lamp.bound, distance);
        const double light = share * std::max({lamp.emission.r, lamp.emission.g, lamp.emission.b});
        shares.emplace_back(share, light);
        all_light += light;
    }
    double smallest = 1.0;
    for (const auto &[share, light] : shares)
        if (light >= least_light * all_light)
            smallest = std::min(smallest, share);
    return smallest;
}

bool may_miss_lamps(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings,
                    std::uint64_t samples) {
    constexpr double enough_hits = 1000.0; // calibrated (shaders/README.md, section 11)
    if (!finds_lamps_by_chance(settings.estimator, settings.max_path_length))
        return false;
    const double lamp_share = smallest_lamp_share(lamps_of(scene, camera));
    const double share = std::min(lamp_share, smallest_lobe_share(scene, settings.estimator));
    return static_cast<double>(samples) * share < enough_hits;
}

// Errors of lamps with fewer expected hits are uncertain. Calibrated.
constexpr double few_hits = 10.0;

// The errors of missed lamps and of the light that samples hit are independent, so their squares add up.
void take_in_unmet_lamps(ErrorEstimate &error, const UnmetSquares &unmet, double value_count) {
    const auto raise = [&](const ExpectedSquares &squares, Interval &interval) {
        if (squares.sum == 0.0)
            return false;
        const double hits = squares.hits();
        const double root = std::sqrt(squares.sum / value_count) * (1.0 + share_added(hits));
        const bool is_uncertain = hits < few_hits && uncertain_factor * root > interval.estimate;
        const double bound = root * spread_of_pixels(hits) * (is_uncertain ? uncertain_factor : 1.0);
        interval.estimate = std::hypot(interval.estimate, root);
        interval.high = std::hypot(interval.high, bound);
        return is_uncertain;
    };
    const bool is_rmse_uncertain = raise(unmet.square, error.rmse);
    if (raise(unmet.relative_square, error.relative_rmse) || is_rmse_uncertain)
        error.uncertain |= PT_UNCERTAIN_UNMET;
}

} // namespace pt
