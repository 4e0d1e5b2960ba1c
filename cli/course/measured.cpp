#include "cli/course/measured.h"

#include "cli/compare/kernels.h"
#include "cli/selftest/selftest.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cli {
namespace {

double squared(double x) {
    return x * x;
}

struct Estimate {
    double mean;
    double relative_error; // a standard error
};

// Mean of (a - b)^2 / (m^2 + 0.01) with the mean m of both. The colors of a pixel are not independent.
Estimate relative_difference(const Picture &a, const Picture &b) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < a.radiance.size(); i += 3) {
        double of_pixel = 0.0;
        for (std::size_t channel = i; channel < i + 3; ++channel) {
            const double mean = 0.5 * (double{a.radiance[channel]} + double{b.radiance[channel]});
            of_pixel += squared(double{a.radiance[channel]} - double{b.radiance[channel]}) / (mean * mean + 0.01) / 3.0;
        }
        sum += of_pixel;
        squares += of_pixel * of_pixel;
    }
    const double count = static_cast<double>(a.radiance.size()) / 3.0;
    return {sum / count, sum > 0.0 ? std::sqrt(std::max(squares / (sum * sum) - 1.0 / count, 0.0)) : 0.0};
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

double Picture::variance_error(std::size_t channel) const {
    const double count = static_cast<double>(radiance.size()) / 3.0;
    const double middle = mean("", channel).value;
    double fourth = 0.0;
    for (std::size_t i = channel; i < radiance.size(); i += 3)
        fourth += squared(squared(radiance[i] - middle)) / count;
    const double variance = squared(deviation(channel));
    return variance > 0.0 ? std::sqrt(std::max(fourth / (variance * variance) - 1.0, 0.0) / count) : 0.0;
}

Measured Picture::relative_deviation(const std::string &name, std::size_t channel) const {
    const double value = deviation(channel) / mean("", channel).value;
    return {name, value, standard_errors * 0.5 * variance_error(channel) * value + sample_rounding};
}

Measured relative_variance(const std::string &name, const Picture &picture, double samples, const Picture &single) {
    const auto variance = [](const Picture &of) {
        const double deviation = of.deviation(0);
        return deviation > sample_rounding * of.mean("", 0).value ? squared(deviation) : 0.0;
    };
    if (variance(picture) == 0.0)
        return {name, 0.0, 0.0};
    const double ratio = samples * variance(picture) / variance(single);
    return {name, ratio, standard_errors * std::hypot(picture.variance_error(0), single.variance_error(0)) * ratio};
}

CourseKernels::CourseKernels(std::string shader_dir, std::string device) :
    shader_dir_(std::move(shader_dir)),
    device_(std::move(device)),
    edited_(create_info(device_, shader_dir_)) {}

std::vector<double> CourseKernels::numbers(SceneFile scene, std::uint32_t sample) {
    if (!traced_) {
        traced_folder_.emplace(shader_dir_);
        traced_.emplace(create_info(device_, traced_folder_->path()));
    }
    scene.render.sampler = PT_SAMPLER_HALTON_CP;
    scene.render.first_sample = sample;
    return traced_numbers(render_radiance(*traced_, scene, {1}));
}

Picture CourseKernels::edited(const SceneFile &scene) {
    Picture picture = render(edited_, scene);
    rejected_ += static_cast<double>(edited_.stats().rejected_samples);
    return picture;
}

const Context &CourseKernels::built_in() {
    if (!built_in_)
        built_in_.emplace(create_info(device_, ""));
    return *built_in_;
}

Picture CourseKernels::render(const Context &context, const SceneFile &scene) {
    return {render_radiance(context, scene, {scene.sample_count.value()}), scene.render.width, scene.render.height};
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
    const Estimate edited = error(edited_);
    const Estimate library = error(built_in());
    const double ratio = edited.mean / library.mean;
    return {name, ratio, standard_errors * std::hypot(edited.relative_error, library.relative_error) * ratio};
}

LightVerdict CourseKernels::compare(const SceneFile &scene) {
    const LightRule rule{.rate = 1e-7, .min_change = 0.01};
    return compare_kernels(edited_, built_in(), scene, scene.sample_count.value(), rule,
                           [](std::uint32_t, const LightVerdict &) {});
}

} // namespace cli
