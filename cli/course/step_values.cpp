#include "cli/course/step_values.h"

#include "cli/selftest/selftest.h"

#include <algorithm>

namespace cli {

Values joined(Values first, const Values &more) {
    first.insert(first.end(), more.begin(), more.end());
    return first;
}

Values exact(const Channels &channels, double factor) {
    return {exactly(factor * channels[0]), exactly(factor * channels[1]), exactly(factor * channels[2])};
}

Values near(const Channels &channels) {
    return {nearly(channels[0]), nearly(channels[1]), nearly(channels[2])};
}

Values any_values(std::size_t count) {
    return Values(count, any_value);
}

Weight scaled_cosine(double scale) {
    return [scale](double cosine) { return scale * std::max(cosine, 0.0); };
}

std::vector<Measured> means(const Picture &picture, const std::string &what) {
    return {picture.mean(what + ", red", 0), picture.mean(what + ", green", 1), picture.mean(what + ", blue", 2)};
}

std::vector<Measured> floor_means(CourseKernels &kernels, std::uint32_t estimator) {
    SceneFile scene = lamps_above_a_floor(64, 64);
    scene.render.estimator = estimator;
    return means(kernels.edited(scene), "floor under five lamps");
}

Measured ball_mean(CourseKernels &kernels, std::uint32_t estimator) {
    SceneFile scene = lamp_in_a_ball().scene;
    scene.render.estimator = estimator;
    scene.render.sampler = PT_SAMPLER_RANDOM;
    scene.render.width = scene.render.height = 64;
    return kernels.edited(scene).mean("lamp in a ball", 0);
}

} // namespace cli
