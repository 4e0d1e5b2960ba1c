// Measurements of a student's kernel by its pictures.
#pragma once

#include "cli/base/context.h"
#include "cli/compare/light.h"
#include "cli/course/traced_numbers.h"
#include "cli/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

inline constexpr double standard_errors = 5.4; // exceeded once in ten million by a normal deviate

struct Measured {
    std::string name;
    double value;
    double bound; // A right kernel's value deviates by less, except once in ten million.
};

struct Picture {
    std::vector<float> radiance; // three values a pixel
    std::uint32_t width;
    std::uint32_t height;

    double at(std::uint32_t x, std::uint32_t y, std::size_t channel) const;
    Measured mean(const std::string &name, std::size_t channel) const;
    double deviation(std::size_t channel) const;      // standard deviation over the pixels
    double variance_error(std::size_t channel) const; // relative standard error of the square of deviation()

    Measured relative_deviation(const std::string &name, std::size_t channel) const;
};

// Red variance over the pixels times `samples`, divided by the variance of single samples.
Measured relative_variance(const std::string &name, const Picture &picture, double samples, const Picture &single);

class CourseKernels {
public:
    CourseKernels(std::string shader_dir, std::string device);

    Picture edited(const SceneFile &scene);
    double rejected() const { return rejected_; } // samples of all pictures by edited()

    // Shifted numbers of a sample, if the kernel passes them to traced_number().
    std::vector<double> numbers(SceneFile scene, std::uint32_t sample);

    // Samples per library sample, at the same relative square error.
    Measured samples_needed(const std::string &name, SceneFile scene);

    // The sequential test of `pt compare`.
    LightVerdict compare(const SceneFile &scene);

private:
    static Picture render(const Context &context, const SceneFile &scene);
    const Context &built_in();

    std::string shader_dir_;
    std::string device_;
    Context edited_;
    double rejected_ = 0.0;
    std::optional<Context> built_in_;
    std::optional<TracedFolder> traced_folder_;
    std::optional<Context> traced_;
};

} // namespace cli
