#include "cli/course/step_parts.h"
#include "cli/course/step_values.h"

#include <numbers>

namespace cli {
namespace {

constexpr double most_needed = 2.0; // limit of samples_needed(), a rule of the course

constexpr const char *too_many = "too many samples";
constexpr const char *to_each_lamp =
    "At each surface, send a ray to each lamp. Chance and one chosen lamp are too noisy.";

SceneFile lamp_scene(const char *name) {
    SceneFile scene = course_scene(name, 16, 2, PT_ESTIMATOR_LIGHT);
    scene.render.sampler = PT_SAMPLER_RANDOM;
    scene.render.width = 256; // few pixels have most of the error
    scene.render.height = 128;
    return scene;
}

Picture by_lamps(CourseKernels &kernels, SceneFile scene) {
    scene.render.estimator = PT_ESTIMATOR_LIGHT;
    return kernels.edited(scene);
}

} // namespace

std::vector<Measured> measure_lamps(CourseKernels &kernels) {
    std::vector<Measured> measured = floor_means(kernels, PT_ESTIMATOR_LIGHT);
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
    const Range dark = exactly(0.0);
    const Values seen{exactly(disc_emission[0]), exactly(1.0)};
    const auto pattern = [](const char *name, const char *hint, const Values &floor, Range in_ball,
                            Range in_shadow = exactly(0.0)) {
        return Pattern{name, hint, joined(floor, {in_shadow, any_value, any_value, in_ball, any_value})};
    };
    const auto all = [&](const char *name, const char *hint, Range needed) {
        return Pattern{name, hint, joined(joined(exact(right), {dark}), joined(seen, {exactly(ball), needed}))};
    };
    const auto unseen = [&](const char *name, const char *hint, const Values &values) {
        return Pattern{name, hint, joined(any_values(4), joined(values, any_values(2)))};
    };
    const auto of_density = [&](const auto &factor) {
        return exact({right[0] * factor(angles[0]), right[1] * factor(angles[1]), right[2] * factor(angles[2])});
    };
    return {
        all("", "", {0.0, most_needed}),
        pattern("emission counted twice", "A lamp that is sampled must not count where a reflected ray hits it.",
                exact(right, 2.0), exactly(2.0 * ball)),
        pattern("the mean of the lamps", "The light of all lamps adds up: send a ray to each.",
                exact(right, 1.0 / lamp_count), exactly(ball)),
        pattern("no geometric term", "Light from a lamp needs the cosine too.",
                near(lamplight(to_the_normals_side, [](double) { return 2.0; })), any_value),
        pattern("no solid angle", "Directions in a cone have the density 1 / solid angle.",
                of_density([](double angle) { return 1.0 / angle; }), any_value),
        pattern("2 pi instead of the solid angle", "Directions in a cone have the density 1 / solid angle.",
                of_density([](double angle) { return 2.0 * std::numbers::pi / angle; }), any_value),
        pattern("only the first lamp", "Send a ray to each lamp.", {exactly(right[0]), dark, dark}, any_value),
        pattern("no shadows", "Light counts only if the lamp is the nearest surface.", any_values(3), any_value,
                {1e-6, infinity}),
        pattern("paths one vertex long", "The last vertex must not sample lamps.", any_values(3),
                exactly(light_in_a_ball(q, c * c, 4))),
        unseen("the camera sees no lamps", "Emission counts at vertex 1, which no ray to a lamp has sampled.",
               {dark, any_value}),
        unseen("emission dropped that no cone samples",
               "Only the first LAMP_COUNT surfaces have cones. Other emission counts where a reflected ray hits it.",
               {any_value, {0.0, 0.1}}),
        all(too_many, to_each_lamp, {most_needed, infinity})};
}

std::vector<Measured> measure_outside(CourseKernels &kernels) {
    return {kernels.samples_needed("samples needed per library sample", lamp_scene("coursework-outside.json"))};
}

std::vector<Pattern> outside_patterns() {
    return {{"", "", {{0.01, most_needed}}},
            {"lamps out of the frame give no light", to_each_lamp, {exactly(0.0)}},
            {too_many, to_each_lamp, {{most_needed, infinity}}}};
}

} // namespace cli
