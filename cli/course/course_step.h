// The steps of shaders/COURSEWORK.md, with measurements and their values for right steps and usual mistakes.
#pragma once

#include "cli/course/verdict.h"

#include <functional>
#include <string>
#include <vector>

namespace cli {

struct CourseStep {
    std::string name; // such as "6a"
    std::string title;
    unsigned points;
    std::vector<std::vector<Measured> (*)(CourseKernels &)> measure; // in stages, until a mistake has a name
    std::vector<Pattern> (*patterns)();                              // takes a tenth of a second for some steps
    std::function<SceneFile()> same_light;                           // may be empty
};

const std::vector<CourseStep> &course_steps();

CourseVerdict check_step(CourseKernels &kernels, const CourseStep &step);

// Judges the first stage.
CourseVerdict check_quickly(CourseKernels &kernels, const CourseStep &step);

} // namespace cli
