#include "cli/course/step_parts.h"
#include "cli/course/step_values.h"

#include <cmath>
#include <numbers>

namespace cli {
namespace {

constexpr double most_needed = 2.0; // limit of samples_needed(), a rule of the course

constexpr const char *to_a_lamp = "Send a ray to a lamp at each surface.";

SceneFile lamp_scene(const char *name) {
    SceneFile scene = course_scene(name, 16, 2, PT_ESTIMATOR_LIGHT);
    scene.render.sampler = PT_SAMPLER_RANDOM;
    scene.render.width = 256; // few pixels have most of the error
    scene.render.height = 128;
    return scene;
}

Picture by_lamps(const CourseKernels &kernels, SceneFile scene) {
    scene.render.estimator = PT_ESTIMATOR_LIGHT;
    return kernels.edited(scene);
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
    measured.push_back(by_lamps(kernels, shadow()).mean("full shadow", 0));
    return measured;
}

std::vector<Measured> measure_seen_lamps(CourseKernels &kernels) {
    const Picture lamp = by_lamps(kernels, disc(false));
    return {{"a lamp's emission, red", lamp.at(lamp.width / 2, lamp.height / 2, 0), 1e-4},
            by_lamps(kernels, floor_under_the_sky()).mean("floor under a sky, red", 0)};
}

std::vector<Measured> measure_lamp_noise(CourseKernels &kernels) {
    return {ball_mean(kernels, PT_ESTIMATOR_LIGHT),
            kernels.samples_needed("samples needed per library sample", lamp_scene("coursework-lamps.json"))};
}

std::vector<Pattern> lamp_patterns() {
    const Channels right = right_lamplight();
    const Channels angles = lamp_solid_angles();
    const double c = ball_cosine();
    const double q = 1.0 - c * c;
    const double ball = light_in_a_ball(q, c * c);
    const double x = red_lamp_cosine();
    const Range dark = exactly(0.0);
    const Values seen{exactly(disc_emission[0]), exactly(1.0)};
    const char *by_chance = "lamps are hit by chance";
    const auto pattern = [](const char *name, const char *hint, const Values &floor, Range in_ball,
                            Range in_shadow = exactly(0.0)) {
        return Pattern{name, hint, joined(floor, {any_value, in_shadow, any_value, any_value, in_ball, any_value})};
    };
    const auto all = [&](const char *name, const char *hint, Range deviation, Range needed) {
        return Pattern{name, hint,
                       joined(joined(exact(right), {deviation, dark}), joined(seen, {exactly(ball), needed}))};
    };
    const auto noisy = [&](const char *name, const char *hint, double variance) {
        return all(name, hint, exactly(std::sqrt(variance)), {most_needed, infinity});
    };
    const auto unseen = [&](const char *name, const char *hint, const Values &values) {
        return Pattern{name, hint, joined(any_values(5), joined(values, any_values(2)))};
    };
    const auto of_density = [&](const auto &factor) {
        return exact({right[0] * factor(angles[0]), right[1] * factor(angles[1]), right[2] * factor(angles[2])});
    };
    return {
        all("", "", any_value, {0.0, most_needed}),
        pattern("emission counted twice", "A lamp that is sampled must not count where a reflected ray hits it.",
                exact(right, 2.0), exactly(2.0 * ball)),
        pattern("probability of the lamp forgotten", "Divide by the probability of choosing this lamp.",
                exact(right, 1.0 / lamp_count), exactly(ball)),
        pattern("no geometric term", "Light from a lamp needs the cosine too.",
                near(lamplight(to_the_normals_side, [](double) { return 2.0; })), any_value),
        pattern("no solid angle", "Directions in a cone have the density 1 / solid angle.",
                of_density([](double angle) { return 1.0 / angle; }), any_value),
        pattern("2 pi instead of the solid angle", "Directions in a cone have the density 1 / solid angle.",
                of_density([](double angle) { return 2.0 * std::numbers::pi / angle; }), any_value),
        pattern("only the first lamp", "Send a ray to each lamp, or choose one of them all.",
                {exactly(right[0]), dark, dark}, any_value),
        pattern("no shadows", "Light counts only if the lamp is the nearest surface.", any_values(3), any_value,
                {1e-6, infinity}),
        pattern("paths one vertex long", "The last vertex must not sample lamps.", any_values(3),
                exactly(light_in_a_ball(q, c * c, 4))),
        unseen("the camera sees no lamps", "Emission counts at vertex 1, which no ray to a lamp has sampled.",
               {dark, any_value}),
        unseen("emission dropped that no cone samples",
               "Only the first LAMP_COUNT surfaces have cones. Other emission counts where a reflected ray hits it.",
               {any_value, {0.0, 0.1}}),
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
    return {{"", "", {{0.01, most_needed}}},
            {"lamps out of the frame give no light", to_a_lamp, {exactly(0.0)}},
            {"lamps hit by chance or chosen alike",
             "Sample every lamp, or choose one by emission and solid angle.",
             {{most_needed, infinity}}}};
}

} // namespace cli
