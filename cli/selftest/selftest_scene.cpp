#include "cli/selftest/selftest_scene.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>

namespace cli {
namespace {

// Probability that a right device fails one check: over all scenes, about one in a million.
constexpr double false_alarm = 1e-7;

// Bernstein's inequality (Boucheron, Lugosi and Massart, Concentration Inequalities, 2013, section 2.8), which holds
// for skewed samples too: for n independent samples of variance s^2 and deviations up to m,
//     P(|error| > t) <= 2 exp(-n t^2 / (2 s^2 + 2 m t / 3)).
// Solved for t. A sample that is 0, or with probability p another value, has s^2 = (1 - p) / p and deviates by s^2
// upwards and 1 downwards: m = s^2 + 6 s holds for all p up to 0.97, and leaves smooth integrands six standard
// deviations. Samples of a stratified sampler are not independent, but less noisy.
double noise_bound(double relative_std, double sample_count) {
    const double log_probability = std::log(2.0 / false_alarm);
    const double variance = relative_std * relative_std;
    const double linear = log_probability * (variance + 6.0 * relative_std) / 3.0;
    return (linear + std::sqrt(linear * linear + 2.0 * sample_count * variance * log_probability)) / sample_count;
}

// The mean of every third value.
double channel_mean(std::span<const float> radiance, std::size_t channel) {
    double sum = 0.0;
    for (std::size_t i = channel; i < radiance.size(); i += 3)
        sum += static_cast<double>(radiance[i]);
    return sum / (static_cast<double>(radiance.size()) / 3.0);
}

std::string comparison(double measured, double expected) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%.9g, exact is %.9g", measured, expected);
    return text.data();
}

} // namespace

pt_scene SelftestScene::scene() const {
    const auto size = [](const auto &items) { return static_cast<std::uint32_t>(items.size()); };
    pt_scene scene{};
    scene.struct_size = sizeof scene;
    scene.material_count = size(materials);
    scene.sphere_count = size(spheres);
    scene.plane_count = size(planes);
    scene.materials = materials.data();
    scene.spheres = spheres.data();
    scene.planes = planes.data();
    return scene;
}

double SelftestScene::bound() const {
    const double samples = static_cast<double>(sample_count) * render.width * render.height;
    return rounding + (relative_std > 0.0 ? noise_bound(relative_std, samples) : 0.0);
}

SelftestCheck SelftestScene::judge(std::span<const float> radiance) const {
    double worst_error = 0.0;
    double worst = expected;
    const auto compare = [&](double measured) {
        const double error = std::abs(measured / expected - 1.0);
        if (!(error <= worst_error)) { // also if it is NaN
            worst_error = std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
            worst = measured;
        }
    };
    if (relative_std > 0.0)
        for (std::size_t channel = 0; channel < 3; ++channel)
            compare(channel_mean(radiance, channel));
    else
        for (const float value : radiance)
            compare(static_cast<double>(value));
    return {"scene", name, worst_error, bound(), "relative", comparison(worst, expected)};
}

} // namespace cli
