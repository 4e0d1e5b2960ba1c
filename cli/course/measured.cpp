#include "cli/course/measured.h"

#include "cli/compare/kernels.h"
#include "cli/selftest/selftest.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cli {
namespace {

constexpr double standard_errors = 5.4; // exceeded once in ten million by a normal deviate

// Mean of (a - b)^2 / (m^2 + 0.01) with the mean m of both.
double relative_difference(const Picture &a, const Picture &b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.radiance.size(); ++i) {
        const double difference = double{a.radiance[i]} - double{b.radiance[i]};
        const double mean = 0.5 * (double{a.radiance[i]} + double{b.radiance[i]});
        sum += difference * difference / (mean * mean + 0.01);
    }
    return sum / static_cast<double>(a.radiance.size());
}

} // namespace

double Picture::at(std::uint32_t x, std::uint32_t y, std::size_t channel) const {
    return radiance[3 * (std::size_t{y} * width + x) + channel];
}

double Picture::deviation(std::size_t channel) const {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = channel; i < radiance.size(); i += 3) {
        sum += radiance[i];
        squares += double{radiance[i]} * radiance[i];
    }
    const double count = static_cast<double>(radiance.size()) / 3.0;
    return std::sqrt(std::max(squares / count - sum * sum / (count * count), 0.0));
}

Measured Picture::mean(const std::string &name, std::size_t channel) const {
    double sum = 0.0;
    for (std::size_t i = channel; i < radiance.size(); i += 3)
        sum += radiance[i];
    const double count = static_cast<double>(radiance.size()) / 3.0;
    const double mean = sum / count;
    return {name, mean, standard_errors * deviation(channel) / std::sqrt(count) + sample_rounding * std::abs(mean)};
}

CourseKernels::CourseKernels(std::string shader_dir, std::string device) :
    device_(std::move(device)),
    edited_(create_info(device_, shader_dir)) {}

const Context &CourseKernels::built_in() {
    if (!built_in_)
        built_in_.emplace(create_info(device_, ""));
    return *built_in_;
}

Picture CourseKernels::render(const Context &context, const SceneFile &scene) {
    Picture picture{render_radiance(context, scene, {scene.sample_count.value()}), scene.render.width,
                    scene.render.height, 0.0};
    picture.rejected = static_cast<double>(context.stats().rejected_samples);
    return picture;
}

Measured CourseKernels::samples_needed(const std::string &name, SceneFile scene) {
    const auto error = [&](const Context &context) {
        std::array<Picture, 2> pictures;
        for (std::uint32_t i = 0; i < 2; ++i) {
            scene.render.seed = i;
            pictures[i] = render(context, scene);
        }
        return relative_difference(pictures[0], pictures[1]);
    };
    // The error of a mean over n values has a relative deviation of about sqrt(2 / n), more where few pixels dominate.
    constexpr double relative_bound = 0.2;
    const double ratio = error(edited_) / error(built_in());
    return {name, ratio, relative_bound * ratio};
}

LightVerdict CourseKernels::compare(const SceneFile &scene) {
    const LightRule rule{.rate = 1e-7, .min_change = 0.01};
    return compare_kernels(edited_, built_in(), scene, scene.sample_count.value(), rule,
                           [](std::uint32_t, const LightVerdict &) {});
}

} // namespace cli
