#include "cli/base/exit_code.h"
#include "cli/base/options.h"
#include "cli/base/text.h"
#include "cli/commands.h"
#include "cli/course/course_files.h"
#include "cli/course/course_step.h"

#include <algorithm>
#include <iostream>

namespace cli {
namespace {

struct CourseOptions {
    std::string folder;
    std::string step;
    std::string shader_dir;
    std::string device;
    bool grades = false;
};

std::vector<std::string> step_names() {
    std::vector<std::string> names;
    for (const CourseStep &step : course_steps())
        names.push_back(step.name);
    return names;
}

std::string range_text(const Range &range) {
    if (range.least == range.most)
        return formatted("%.5g", range.least);
    return std::isinf(range.least) ? "any" : formatted("%.3g to %.3g", range.least, range.most);
}

std::string judgement(const CourseVerdict &verdict) {
    if (verdict.is_right())
        return "right";
    if (!verdict.other_light.empty())
        return "wrong: " + verdict.other_light;
    if (!verdict.fitting)
        return "wrong: no usual mistake fits";
    return "wrong: " + verdict.fitting->name + ". " + verdict.fitting->hint;
}

std::string verdict_text(const CourseVerdict &verdict) {
    const std::string text = judgement(verdict);
    return verdict.rejected > 0.0
               ? text + formatted(" (%.0f samples were NaN, infinite, negative or too bright)", verdict.rejected)
               : text;
}

std::string report(const CourseStep &step, const CourseVerdict &verdict) {
    std::string text = concat("step ", step.name, ": ", step.title, "\n\n") +
                       formatted("  %-36s  %11s  %11s  %9s\n", "check", "measured", "right", "bound");
    for (std::size_t i = 0; i < verdict.measured.size(); ++i) {
        const Measured &measured = verdict.measured[i];
        text += formatted("  %-36s  %11.5g  %11s  %9.2g\n", measured.name.c_str(), measured.value,
                          range_text(verdict.expected.at(i)).c_str(), measured.bound);
    }
    return text + "\n" + verdict_text(verdict) + "\n";
}

int grade(const std::string &folder, const std::string &device) {
    CourseKernels kernels(folder, device);
    unsigned total = 0;
    unsigned most = 0;
    std::cout << formatted("%-4s  %-40s  %6s  %s\n", "part", "step", "points", "verdict");
    for (const CourseStep &step : course_steps()) {
        const CourseVerdict verdict = check_step(kernels, step);
        const unsigned points = verdict.is_right() ? step.points : 0;
        total += points;
        most += step.points;
        std::cout << formatted("%-4s  %-40s  %2u/%-3u  ", step.name.c_str(), step.title.c_str(), points, step.points)
                  << verdict_text(verdict) << std::endl;
    }
    std::cout << formatted("%-46s  %2u/%-3u\n", "all", total, most);
    return static_cast<int>(ExitCode::done);
}

constexpr const char *next_step = "next";

// A mistake of the next step may already spoil pictures of this one, and only the next step has its name.
int check_next(CourseKernels &kernels) {
    const std::vector<CourseStep> &steps = course_steps();
    for (auto step = steps.begin(); step != steps.end(); ++step) {
        const CourseVerdict verdict = check_step(kernels, *step);
        if (verdict.is_right())
            continue;
        if (const auto after = std::next(step); !verdict.fitting && after != steps.end()) {
            const CourseVerdict later = check_step(kernels, *after);
            if (later.fitting && !later.is_right()) {
                std::cout << report(*after, later);
                return static_cast<int>(ExitCode::images_differ);
            }
        }
        std::cout << report(*step, verdict);
        return static_cast<int>(ExitCode::images_differ);
    }
    std::cout << "all steps are right\n";
    return static_cast<int>(ExitCode::done);
}

int check(const CourseOptions &options) {
    const auto step = std::ranges::find(course_steps(), options.step, &CourseStep::name);
    const bool is_next = options.step == next_step;
    refuse_if(step == course_steps().end() && !is_next,
              "--check " + options.step + ": the steps are " + listed(step_names()));
    refuse_if(options.shader_dir.empty(), "--check needs --shader-dir, the folder with the kernel");
    CourseKernels kernels(options.shader_dir, options.device);
    if (is_next)
        return check_next(kernels);
    const CourseVerdict verdict = check_step(kernels, *step);
    std::cout << report(*step, verdict) << std::flush;
    if (!verdict.is_right())
        return static_cast<int>(ExitCode::images_differ);
    for (auto earlier = course_steps().begin(); earlier != step; ++earlier) {
        if (const CourseVerdict before = check_quickly(kernels, *earlier); !before.is_right()) {
            std::cout << "but step " << earlier->name << " is " << verdict_text(before) << "\n";
            break;
        }
    }
    return static_cast<int>(ExitCode::done);
}

int run_course(const CourseOptions &options) {
    if (!options.step.empty())
        return check(options);
    refuse_if(options.folder.empty(), "DIR or --check is required");
    if (options.grades)
        return grade(options.folder, options.device);
    write_course(options.folder);
    return static_cast<int>(ExitCode::done);
}

constexpr const char *course_help =
    "The command fills DIR, which must be empty or new, with the kernel to begin with (pathtrace.comp), the\n"
    "files that it includes, and scenes. --check exits with 0 if the step is right and with 8 if it is not,\n"
    "and names the usual mistake whose predicted values fit. --grade judges all steps of one kernel, but not\n"
    "its comments and names. shaders/COURSEWORK.md describes the steps.\n";

} // namespace

void add_course_command(CLI::App &program, Run &chosen) {
    const auto [command, options] =
        add_command(program, chosen, "course", "Begin, check or grade the course", course_help, &run_course);
    add_text(command, "DIR", options.folder, "DIR", "Folder to begin in, or to grade");
    add_text(command, "--check", options.step, "STEP",
             "Judge this step: " + listed(step_names()) + "; next: the first that is not right");
    command.add_flag("--grade", options.grades, "Judge the kernel in DIR: the points of each step");
    add_shader_dir(command, options.shader_dir);
    add_device(command, options.device);
}

} // namespace cli
