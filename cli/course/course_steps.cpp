#include "cli/course/course_scene.h"
#include "cli/course/course_step.h"
#include "cli/course/step_parts.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace cli {
namespace {

SceneFile equal_light(const char *name, std::uint32_t length, std::uint32_t estimator) {
    constexpr std::uint32_t samples = 128;
    SceneFile scene = course_scene(name, samples, length, estimator);
    scene.render.sampler = PT_SAMPLER_RANDOM; // a mistake in the numbers belongs to their own step
    return scene;
}

CourseVerdict judge_stages(CourseKernels &kernels, const CourseStep &step) {
    const std::vector<Pattern> patterns = step.patterns();
    CourseVerdict verdict;
    for (const auto &measure : step.measure) {
        std::ranges::move(measure(kernels), std::back_inserter(verdict.measured));
        verdict = judge(std::move(verdict.measured), patterns);
        if (verdict.fitting && !verdict.is_right())
            return verdict;
    }
    if (verdict.is_right() && step.same_light) {
        const LightVerdict light = kernels.compare(step.same_light());
        if (light.is_different())
            verdict.other_light = light.comparison.summary;
    }
    return verdict;
}

} // namespace

// The exercise fixes 6 of the points of step 2, 10 of step 3, and all of 6a to 6c. The rest of 100 is divided here.
const std::vector<CourseStep> &course_steps() {
    static const std::vector<CourseStep> steps{
        {"1", "emission", 10, {measure_emission}, emission_patterns, {}},
        {"2", "directions and bounces", 16, {measure_directions}, direction_patterns, {}},
        {"3",
         "geometric term, reflectance, throughput",
         20,
         {measure_throughput, measure_lobe},
         throughput_patterns,
         [] { return equal_light("coursework.json", 3, PT_ESTIMATOR_UNIFORM); }},
        {"4", "numbers by dimension", 20, {measure_numbers, measure_dimensions, measure_samplers}, number_patterns, {}},
        {"5", "box filter", 8, {measure_filter}, filter_patterns, {}},
        {"6a",
         "directions by the geometric term",
         12,
         {measure_cosine, measure_uniform_beside},
         cosine_patterns,
         [] { return equal_light("coursework-diffuse.json", 2, PT_ESTIMATOR_COSINE); }},
        {"6b",
         "lamps of very different emission",
         6,
         {measure_lamps, measure_seen_lamps, measure_lamp_noise},
         lamp_patterns,
         [] { return equal_light("coursework-lamps.json", 2, PT_ESTIMATOR_LIGHT); }},
        {"6c",
         "lamps out of the frame",
         2,
         {measure_outside},
         outside_patterns,
         [] { return equal_light("coursework-outside.json", 2, PT_ESTIMATOR_LIGHT); }},
        {"7",
         "motion",
         6,
         {measure_motion, measure_moving_normals},
         motion_patterns,
         [] { return equal_light("coursework-motion.json", 2, PT_ESTIMATOR_LIGHT); }},
    };
    return steps;
}

CourseVerdict check_step(CourseKernels &kernels, const CourseStep &step) {
    const double before = kernels.rejected();
    CourseVerdict verdict = judge_stages(kernels, step);
    verdict.rejected = kernels.rejected() - before;
    return verdict;
}

CourseVerdict check_quickly(CourseKernels &kernels, const CourseStep &step) {
    return judge(step.measure.front()(kernels), step.patterns());
}

} // namespace cli
