#include "cli/course/step_parts.h"
#include "cli/course/step_values.h"

#include <cmath>

namespace cli {
namespace {

constexpr double most_needed = 2.0; // limit of samples_needed(), a rule of the course

SceneFile lamp_scene(const char *name) {
    SceneFile scene = course_scene(name, 16, 2, PT_ESTIMATOR_LIGHT);
    scene.render.sampler = PT_SAMPLER_RANDOM;
    scene.render.width = 256; // many pixels, because few of them have most of the error
    scene.render.height = 128;
    return scene;
}

// Relative variances of a sample's light from the red lamp, which fills a cone about the normal. x is the cosine of its
// half angle, and the light is 1 - x^2.
constexpr double square_light(double x) {
    return (1.0 - x * x) * (1.0 - x * x);
}

// The sample goes to one of `count` lamps. Its mean square is count times the mean of
// (2 (1 - x) cosine)^2 over the cone.
constexpr double variance_of_choice(double x, double count) {
    return count * 4.0 / 3.0 * (1.0 - x) * (1.0 - x * x * x) / square_light(x) - 1.0;
}

// If a direction hits the lamp, the sample is 1 with the density cosine / pi, and 2 cosine with uniform directions.
constexpr double variance_by_cosine(double x) {
    return 1.0 / (1.0 - x * x) - 1.0;
}

constexpr double variance_of_uniform(double x) {
    return 4.0 / 3.0 * (1.0 - x * x * x) / square_light(x) - 1.0;
}

} // namespace

std::vector<Measured> measure_lamps(CourseKernels &kernels) {
    const Picture floor = floor_picture(kernels, PT_ESTIMATOR_LIGHT);
    std::vector<Measured> measured = means(floor, "floor under five lamps");
    Measured deviation = floor.relative_deviation("deviation of a sample, red", 0);
    deviation.value *= std::sqrt(floor_samples);
    deviation.bound *= std::sqrt(floor_samples);
    measured.push_back(deviation);
    measured.push_back(ball_mean(kernels, PT_ESTIMATOR_LIGHT));
    SceneFile dark = shadow();
    dark.render.estimator = PT_ESTIMATOR_LIGHT;
    measured.push_back(kernels.edited(dark).mean("full shadow", 0));
    measured.push_back(
        kernels.samples_needed("samples needed per library sample", lamp_scene("coursework-lamps.json")));
    return measured;
}

std::vector<Pattern> lamp_patterns() {
    const Channels right = right_lamplight();
    const double c = ball_cosine();
    const double q = 1.0 - c * c;
    const double ball = light_in_a_ball(q, c * c);
    const Range dark = exactly(0.0);
    const double x = red_lamp_cosine();
    const char *by_chance = "lamps are hit by chance";
    const char *to_a_lamp = "Send a ray to a lamp at each surface.";
    const auto noisy = [&](const char *name, const char *hint, double variance) {
        return Pattern{
            name, hint,
            joined(exact(right), {exactly(std::sqrt(variance)), exactly(ball), dark, {most_needed, infinity}})};
    };
    return {{"", "", joined(exact(right), {any_value, exactly(ball), dark, {0.0, most_needed}})},
            {"emission counted twice", "A lamp that is sampled must not count where a reflected ray hits it.",
             joined(exact(right, 2.0), {any_value, exactly(2.0 * ball), dark, any_value})},
            {"probability of the lamp forgotten", "Divide by the probability of choosing this lamp.",
             joined(exact(right, 1.0 / lamp_count), {any_value, exactly(ball), dark, any_value})},
            {"no geometric term", "Light from a lamp needs the cosine too.",
             joined(near(lamplight(to_the_normals_side, [](double) { return 2.0; })),
                    {any_value, any_value, dark, any_value})},
            {"no shadows", "Light counts only if the lamp is the nearest surface.",
             joined(any_values(5), {{1e-6, infinity}, any_value})},
            {"paths one vertex long", "The last vertex must not sample lamps.",
             joined(any_values(4), {exactly(light_in_a_ball(q, c * c, 4)), dark, any_value})},
            noisy("lamps chosen alike", "Sample every lamp, or choose one by emission and solid angle.",
                  variance_of_choice(x, lamp_count)),
            noisy(by_chance, to_a_lamp, variance_by_cosine(x)),
            noisy(by_chance, to_a_lamp, variance_of_uniform(x))};
}

std::vector<Measured> measure_outside(CourseKernels &kernels) {
    return {kernels.samples_needed("samples needed per library sample", lamp_scene("coursework-outside.json"))};
}

// Both mistakes have nearly the same noise.
std::vector<Pattern> outside_patterns() {
    return {{"", "", {{0.0, most_needed}}},
            {"lamps hit by chance or chosen alike",
             "Sample every lamp, or choose one by emission and solid angle.",
             {{most_needed, infinity}}}};
}

} // namespace cli
