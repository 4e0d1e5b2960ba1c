#pragma once

#include "cli/course/course_scene.h"

namespace cli {

using Values = std::vector<Range>;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

Values joined(Values first, const Values &more);
Values exact(const Channels &channels, double factor = 1.0);
Values near(const Channels &channels);
Values any_values(std::size_t count);

Weight scaled_cosine(double scale);

std::vector<Measured> means(const Picture &picture, const std::string &what);

std::vector<Measured> floor_means(CourseKernels &kernels, std::uint32_t estimator);
Measured ball_mean(CourseKernels &kernels, std::uint32_t estimator);

} // namespace cli
