#pragma once

#include "cli/course/verdict.h"

#include <vector>

namespace cli {

std::vector<Measured> measure_emission(CourseKernels &kernels);
std::vector<Pattern> emission_patterns();

std::vector<Measured> measure_directions(CourseKernels &kernels);
std::vector<Pattern> direction_patterns();

std::vector<Measured> measure_throughput(CourseKernels &kernels);
std::vector<Measured> measure_lobe(CourseKernels &kernels);
std::vector<Pattern> throughput_patterns();

std::vector<Measured> measure_numbers(CourseKernels &kernels);
std::vector<Measured> measure_samplers(CourseKernels &kernels);
std::vector<Measured> measure_dimensions(CourseKernels &kernels);
std::vector<Pattern> number_patterns();

std::vector<Measured> measure_filter(CourseKernels &kernels);
std::vector<Pattern> filter_patterns();

std::vector<Measured> measure_cosine(CourseKernels &kernels);
std::vector<Measured> measure_uniform_beside(CourseKernels &kernels);
std::vector<Pattern> cosine_patterns();

std::vector<Measured> measure_lamps(CourseKernels &kernels);
std::vector<Measured> measure_seen_lamps(CourseKernels &kernels);
std::vector<Measured> measure_lamp_noise(CourseKernels &kernels);
std::vector<Pattern> lamp_patterns();

std::vector<Measured> measure_outside(CourseKernels &kernels);
std::vector<Pattern> outside_patterns();

std::vector<Measured> measure_motion(CourseKernels &kernels);
std::vector<Measured> measure_moving_normals(CourseKernels &kernels);
std::vector<Pattern> motion_patterns();

} // namespace cli
