#include "cli/course/course_scene.h"
#include "cli/course/course_step.h"
#include "cli/selftest/selftest.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cli {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

using Values = std::vector<Range>;

Values joined(Values first, const Values &more) {
    first.insert(first.end(), more.begin(), more.end());
    return first;
}

Values exact(const Channels &channels, double factor = 1.0) {
    return {exactly(factor * channels[0]), exactly(factor * channels[1]), exactly(factor * channels[2])};
}

Values near(const Channels &channels) {
    return {nearly(channels[0]), nearly(channels[1]), nearly(channels[2])};
}

Values any_values(std::size_t count) {
    return Values(count, any_value);
}

Weight scaled_cosine(double scale) {
    return [scale](double cosine) { return scale * std::max(cosine, 0.0); };
}

double no_weight_below(double cosine, double weight) {
    return cosine > 0.0 ? weight : 0.0;
}

std::vector<Measured> means(const Picture &picture, const std::string &what) {
    return {picture.mean(what + ", red", 0), picture.mean(what + ", green", 1), picture.mean(what + ", blue", 2)};
}

std::vector<Measured> floor_means(const CourseKernels &kernels, std::uint32_t estimator) {
    SceneFile scene = lamps_above_a_floor(64, 64);
    scene.render.estimator = estimator;
    return means(kernels.edited(scene), "floor under five lamps");
}

Measured ball_mean(const CourseKernels &kernels, std::uint32_t estimator) {
    SceneFile scene = lamp_in_a_ball().scene;
    scene.render.estimator = estimator;
    scene.render.sampler = PT_SAMPLER_RANDOM;
    scene.render.width = scene.render.height = 64;
    return kernels.edited(scene).mean("lamp in a ball", 0);
}

// ---- 1: emission ----------------------------------------------------------------------------------------------------

std::vector<Measured> measure_emission(CourseKernels &kernels) {
    const Picture picture = kernels.edited(disc(false));
    const std::uint32_t middle = picture.width / 2;
    const auto color = [&](const char *name, std::size_t channel) {
        const double value = picture.at(middle, middle, channel);
        return Measured{name, value, 1e-5 * value};
    };
    // Middles of pixels cover the disc to within 2%.
    const double share = std::numbers::pi * disc_radius * disc_radius / (picture.width * picture.height);
    const double mean = picture.mean("", 0).value;
    return {color("a lamp's emission, red", 0),
            color("a lamp's emission, green", 1),
            color("a lamp's emission, blue", 2),
            {"its disc's share of the picture", mean / picture.at(middle, middle, 0), 0.02 * share}};
}

std::vector<Pattern> emission_patterns() {
    const double share = std::numbers::pi * disc_radius * disc_radius / (32.0 * 32.0);
    const auto values = [&](const std::function<double(double)> &curve) {
        return Values{exactly(curve(disc_emission[0])), exactly(curve(disc_emission[1])),
                      exactly(curve(disc_emission[2])), exactly(share)};
    };
    return {{"", "", values([](double e) { return e; })},
            {"gamma twice", "Return linear radiance: the display's curve is applied to the picture later.",
             values([](double e) { return std::pow(e, 1.0 / 2.2); })},
            {"emission cut off at 1", "Lamps are brighter than white. Do not clamp.",
             values([](double e) { return std::min(e, 1.0); })},
            {"no emission",
             "Copy the emission into the material and return it.",
             {exactly(0.0), exactly(0.0), exactly(0.0), any_value}},
            {"the start",
             "Return the material's emission instead of the shape.",
             {exactly(disc_cosine()), exactly(disc_cosine()), exactly(disc_cosine()), any_value}}};
}

// ---- 2: directions --------------------------------------------------------------------------------------------------

constexpr std::uint32_t ball_length = 4;

std::vector<Measured> measure_directions(CourseKernels &kernels) {
    std::vector<Measured> measured = floor_means(kernels, PT_ESTIMATOR_UNIFORM);
    measured.push_back(kernels.edited(glowing_ball(ball_length)).mean("paths in a glowing ball", 0));
    measured.push_back(kernels.edited(floor_under_the_sky()).mean("a floor's own light", 2));
    return measured;
}

// Each mistake is predicted without throughput and with it.
std::vector<Pattern> direction_patterns() {
    const Weight one = [](double cosine) { return no_weight_below(cosine, 1.0); };
    const double above = 1.0 - std::cos(std::numbers::pi / 6.0);
    const double beside = 2.0 * (1.0 - std::cos(25.0 / 180.0 * std::numbers::pi));
    const Channels solid_angles{above, beside, beside};
    const auto sum = [](double albedo, int vertices) {
        double light = 0.0;
        for (int vertex = 0; vertex < vertices; ++vertex)
            light += std::pow(albedo, vertex);
        return nearly(light); // grazing directions leave through the wall that they start on
    };
    std::vector<Pattern> patterns;
    for (const bool has_throughput : {false, true}) {
        const double albedo = has_throughput ? 0.5 : 1.0;
        const Weight weight = has_throughput ? scaled_cosine(2.0) : one;
        const Channels right = has_throughput ? right_lamplight() : solid_angles;
        const Range paths = sum(albedo, ball_length);
        const auto add = [&](const char *name, const char *hint, const Values &lamps, Range ball, Range own) {
            patterns.push_back({name, hint, joined(lamps, {ball, own})});
        };
        add("", "", exact(right), paths, exactly(1.0));
        add("abs(z)", "The half above a surface depends on its normal: turn directions with a negative cosine round.",
            near(lamplight(absolute_z, weight)), any_value, any_value);
        add("directions of the whole sphere", "Turn directions below the surface round.",
            near(lamplight(unturned, weight)), any_value, any_value);
        add("paths one vertex short", "The camera's ray meets vertex 1, so there are MAX_PATH_LENGTH vertices.",
            exact(right, 0.0), sum(albedo, ball_length - 1), exactly(1.0));
        add("paths one vertex long", "The camera's ray meets vertex 1, so there are MAX_PATH_LENGTH vertices.",
            any_values(3), sum(albedo, ball_length + 1), exactly(1.0));
    }
    patterns.push_back({"no bounces", "Continue the path from each surface.",
                        joined(exact({0.0, 0.0, 0.0}), {exactly(1.0), exactly(1.0)})});
    patterns.push_back({"self-intersection", "Skip intersections nearer than NEAR on the surface that a ray leaves.",
                        joined(any_values(4), {{1.0001, infinity}})});
    return patterns;
}

// ---- 3: throughput --------------------------------------------------------------------------------------------------

std::vector<Measured> measure_throughput(CourseKernels &kernels) {
    std::vector<Measured> measured = means(kernels.edited(floor_under_the_sky()), "floor under a sky");
    for (const Measured &mean : floor_means(kernels, PT_ESTIMATOR_UNIFORM))
        measured.push_back(mean);
    measured.push_back(ball_mean(kernels, PT_ESTIMATOR_UNIFORM));
    return measured;
}

std::vector<Pattern> throughput_patterns() {
    constexpr double n = floor_glossiness;
    const double c = ball_cosine();
    const double q = 1.0 - c * c;
    const Channels lamps = right_lamplight();
    const auto scaled = [&](const char *name, const char *hint, double scale) {
        return Pattern{name, hint,
                       joined({exactly(scale), exactly(scale), exactly(1.0)},
                              joined(exact(lamps, scale), {exactly(light_in_a_ball(scale * q, scale * c * c))}))};
    };
    return {scaled("", "", 1.0),
            scaled("missing 2 pi", "One direction counts by 1 / density, which is 2 pi for uniform directions.",
                   1.0 / two_pi),
            scaled("1.98 pi", "The density of uniform directions is 1 / (2 pi); is a constant rounded?", 0.99),
            scaled("the sphere's density", "Directions on a hemisphere have twice the density of those on the sphere.",
                   2.0),
            {"n + 1", "The normalization of this reflectance is (n + 2) / (2 pi), with the cosine.",
             joined({exactly(1.0), exactly((n + 1.0) / (n + 2.0)), exactly(1.0)},
                    joined(exact(lamps), {exactly(light_in_a_ball(q, c * c))}))},
            {"missing 1 / pi", "The diffuse part of the reflectance is the color over pi.",
             joined({exactly(std::numbers::pi), exactly(1.0), exactly(1.0)},
                    joined(exact(lamps, std::numbers::pi),
                           {exactly(light_in_a_ball(std::numbers::pi * q, std::numbers::pi * c * c))}))},
            {"cosine twice", "The geometric term has the cosine; the reflectance does not.",
             joined({exactly(2.0 / 3.0), exactly((n + 2.0) / (n + 3.0)), exactly(1.0)},
                    joined(near(lamplight(to_the_normals_side, [](double x) { return 2.0 * x * x; })),
                           {exactly(light_in_a_ball(2.0 / 3.0 * (1.0 - c * c * c), 2.0 / 3.0 * c * c * c))}))},
            {"no geometric term", "Multiply by the cosine between normal and direction.",
             joined({exactly(2.0), exactly((n + 2.0) / (n + 1.0)), exactly(1.0)},
                    joined(near(lamplight(to_the_normals_side, [](double) { return 2.0; })),
                           {exactly(light_in_a_ball(2.0 * (1.0 - c), 2.0 * c))}))},
            {"throughput of the last surface alone", "The throughput is a product: multiply it, do not replace it.",
             joined({exactly(1.0), exactly(1.0), exactly(1.0)}, joined(exact(lamps), {exactly(50.0 * q * (1.0 + c))}))},
            {"no throughput", "Multiply emission by the throughput of the path that leads to it.",
             joined({exactly(1.0), exactly(1.0), exactly(1.0)},
                    joined(near(lamplight(to_the_normals_side, [](double) { return 1.0; })), {exactly(100.0 * q)}))},
            {"emission counted twice", "Each vertex adds its emission once.",
             joined({any_value, any_value, exactly(2.0)}, any_values(4))},
            {"self-intersection", "Skip intersections nearer than NEAR on the surface that a ray leaves.",
             joined({any_value, any_value, {1.0001, 1.9}}, any_values(4))},
            {"abs(z)", "The half above a surface depends on its normal: turn directions with a negative cosine round.",
             joined(any_values(3), joined(near(lamplight(absolute_z, scaled_cosine(2.0))), {any_value}))}};
}

// ---- 4: numbers -----------------------------------------------------------------------------------------------------

constexpr std::uint32_t number_samples = 64;

std::vector<Measured> measure_numbers(CourseKernels &kernels) {
    SceneFile scene = lamps_above_a_floor(64, number_samples);
    const double random = kernels.edited(scene).deviation(0);
    scene.render.sampler = PT_SAMPLER_HALTON_CP;
    const Picture shifted = kernels.edited(scene);
    std::vector<Measured> measured = means(shifted, "shifted points, five lamps");
    const double ratio = shifted.deviation(0) / random;
    // A variance over 4096 pixels has a relative deviation of about sqrt(2 / 4096).
    measured.push_back({"variance beside random numbers", ratio * ratio, 0.15 * ratio * ratio + 1e-9});
    return measured;
}

std::vector<Pattern> number_patterns() {
    const Channels right = right_lamplight();
    std::vector<Pattern> patterns{
        {"", "", joined(exact(right), {{1e-4, 0.7}})},
        {"numbers are still random", "The sampler halton-cp must return Halton's points.",
         joined(exact(right), {exactly(1.0)})},
        {"pixel shift missing", "Add a random number of the pixel and the dimension, modulo 1.",
         joined(any_values(3), {exactly(0.0)})},
        {"integer division", "1 / base is 0 for integers, so all samples of a pixel have the same numbers.",
         joined(any_values(3), {{number_samples / 1.5, number_samples * 1.5}})},
        {"equal numbers in all dimensions", "Each number of a sample needs a base of its own.",
         joined(any_values(3), {{1.5, number_samples / 2.0}})}};
    for (const double first : {1.0, -1.0})
        patterns.push_back({"equal numbers in all dimensions", "Each number of a sample needs a base of its own.",
                            joined(near(lamplight_of_equal_numbers(first, -first)), {any_value})});
    return patterns;
}

// ---- 5: box filter --------------------------------------------------------------------------------------------------

std::vector<Measured> measure_filter(CourseKernels &kernels) {
    return disc_values(kernels.edited(disc(false)));
}

// `scale` and `offset` apply to uniform places in [0, 1). With is_diagonal both coordinates have the same number.
std::vector<DiscSample> places(double scale, double offset, bool is_diagonal = false, int times = 1) {
    constexpr int side = 16;
    std::vector<DiscSample> samples;
    for (int time = 0; time < times; ++time) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const double across = (x + 0.5) / side;
                const double down = is_diagonal ? across : (y + 0.5) / side;
                samples.push_back({{scale * across + offset, scale * down + offset}, (time + 0.5) / times});
            }
        }
    }
    return samples;
}

std::vector<Pattern> filter_patterns() {
    return {
        {"", "", disc_values(false, places(1.0, 0.0))},
        {"no filter", "Send rays anywhere in the pixel, not only through its middle.",
         disc_values(false, places(0.0, 0.5))},
        {"half a pixel off", "A pixel's places are from 0 to 1, not from -1/2.", disc_values(false, places(1.0, -0.5))},
        {"half a pixel off", "A pixel's places are from 0 to 1: its middle needs no addition.",
         disc_values(false, places(1.0, 0.5))},
        {"equal numbers in all dimensions", "Right and down need a number each.",
         disc_values(false, places(1.0, 0.0, true))},
        {"a box of two pixels", "Numbers in [0, 1) cover one pixel.", disc_values(false, places(2.0, -0.5))}};
}

// ---- 6a: the geometric term -----------------------------------------------------------------------------------------

std::vector<Measured> measure_cosine(CourseKernels &kernels) {
    SceneFile sky = floor_under_the_sky();
    sky.render.estimator = PT_ESTIMATOR_COSINE;
    const Picture picture = kernels.edited(sky);
    std::vector<Measured> measured = floor_means(kernels, PT_ESTIMATOR_COSINE);
    const Measured mean = picture.mean("floor under a sky, red", 0);
    measured.push_back(mean);
    measured.push_back({"its deviation / mean", picture.deviation(0) / mean.value, 0.01});
    return measured;
}

std::vector<Pattern> cosine_patterns() {
    const Channels right = right_lamplight();
    return {{"", "", joined(exact(right), {exactly(1.0), exactly(0.0)})},
            {"directions are still uniform", "With the estimator cosine the density must be cosine / pi.",
             joined(exact(right), {exactly(1.0), exactly(std::sqrt(1.0 / 3.0))})},
            {"cosine twice", "The density cosine / pi cancels the geometric term, which still counts here.",
             joined(near(lamplight(to_the_normals_side, [](double x) { return 4.0 * x * x; })),
                    {exactly(4.0 / 3.0), exactly(std::sqrt(1.0 / 8.0))})},
            {"cosine cancelled, directions uniform", "Leave the geometric term out only if the density has it.",
             joined(near(lamplight(to_the_normals_side, [](double) { return 1.0; })), {exactly(1.0), exactly(0.0)})},
            {"2 pi instead of pi", "The density is cosine / pi: cosines are 1/2 in the mean over a hemisphere.",
             joined(exact(right, 2.0), {exactly(2.0), exactly(0.0)})}};
}

// ---- 6b and 6c: lamps -----------------------------------------------------------------------------------------------

constexpr std::uint32_t lamp_samples = 16;
constexpr double most_needed = 2.0;    // limit of samples_needed()
constexpr double of_directions = 12.0; // the same limit if only chance finds lamps

SceneFile lamp_scene(const char *name) {
    SceneFile scene = course_scene(name, lamp_samples, 2, PT_ESTIMATOR_LIGHT);
    scene.render.sampler = PT_SAMPLER_RANDOM;
    return scene;
}

std::vector<Measured> measure_lamps(CourseKernels &kernels) {
    std::vector<Measured> measured = floor_means(kernels, PT_ESTIMATOR_LIGHT);
    measured.push_back(ball_mean(kernels, PT_ESTIMATOR_LIGHT));
    SceneFile dark = shadow();
    dark.render.estimator = PT_ESTIMATOR_LIGHT;
    measured.push_back(kernels.edited(dark).mean("full shadow", 0));
    measured.push_back(kernels.samples_needed("samples for one of the library's", lamp_scene("coursework-lamps.json")));
    return measured;
}

std::vector<Pattern> lamp_patterns() {
    const Channels right = right_lamplight();
    const double c = ball_cosine();
    const double q = 1.0 - c * c;
    const double ball = light_in_a_ball(q, c * c);
    const Range dark = exactly(0.0);
    return {{"", "", joined(exact(right), {exactly(ball), dark, {0.0, most_needed}})},
            {"emission counted twice", "A lamp that was asked for must not count where a direction meets it.",
             joined(exact(right, 2.0), {exactly(2.0 * ball), dark, any_value})},
            {"probability of the lamp forgotten", "Divide by the probability of choosing this lamp.",
             joined(exact(right, 1.0 / 5.0), {exactly(ball), dark, any_value})},
            {"no geometric term", "Light from a lamp needs the cosine too.",
             joined(near(lamplight(to_the_normals_side, [](double) { return 2.0; })), {any_value, dark, any_value})},
            {"no shadows", "Light counts only if the lamp is the nearest surface.",
             joined(any_values(4), {{1e-6, infinity}, any_value})},
            {"paths one vertex long", "The last vertex must not ask for lamps.",
             joined(any_values(3), {exactly(light_in_a_ball(q, c * c, 4)), dark, any_value})},
            {"lamps chosen alike", "Ask every lamp, or choose by emission and solid angle.",
             joined(exact(right), {exactly(ball), dark, {most_needed, of_directions}})},
            {"lamps are met by chance", "Send a direction to a lamp at each surface.",
             joined(exact(right), {exactly(ball), dark, {of_directions, infinity}})}};
}

std::vector<Measured> measure_outside(CourseKernels &kernels) {
    return {kernels.samples_needed("samples for one of the library's", lamp_scene("coursework-outside.json"))};
}

// Chance and equal choice have nearly the same noise here.
std::vector<Pattern> outside_patterns() {
    return {{"", "", {{0.0, most_needed}}},
            {"lamps met by chance or chosen alike",
             "Ask every lamp, or choose by emission and solid angle.",
             {{most_needed, infinity}}}};
}

// ---- 7: motion ------------------------------------------------------------------------------------------------------

std::vector<Measured> measure_motion(CourseKernels &kernels) {
    return disc_values(kernels.edited(disc(true)));
}

std::vector<Pattern> motion_patterns() {
    const std::vector<DiscSample> right = places(1.0, 0.0, false, 16);
    const auto at = [&](double scale, double offset) {
        std::vector<DiscSample> samples = right;
        for (DiscSample &sample : samples)
            sample.time = scale * sample.time + offset;
        return disc_values(true, samples);
    };
    return {{"", "", at(1.0, 0.0)},
            {"nothing moves", "Give the spheres' positions at the sample's time.", at(0.0, 0.0)},
            {"one time for all samples", "Each sample has a time of its own.", at(0.0, 0.5)},
            {"motion about the start", "The shutter opens at time 0 and closes at 1.", at(1.0, -0.5)},
            {"motion twice as far", "Times are from 0 to 1.", at(2.0, 0.0)}};
}

SceneFile equal_light(const char *name, std::uint32_t length, std::uint32_t estimator) {
    constexpr std::uint32_t samples = 128;
    return course_scene(name, samples, length, estimator);
}

} // namespace

// The exercise prescribes 6 points of step 2, 10 of step 3 and all of step 6. The other steps share the rest of 100.
const std::vector<CourseStep> &course_steps() {
    static const std::vector<CourseStep> steps{
        {"1", "emission", 10, measure_emission, emission_patterns, {}},
        {"2", "directions and bounces", 16, measure_directions, direction_patterns, {}},
        {"3", "geometric term, reflectance, throughput", 20, measure_throughput, throughput_patterns,
         [] { return equal_light("coursework.json", 3, PT_ESTIMATOR_UNIFORM); }},
        {"4", "numbers by dimension", 20, measure_numbers, number_patterns, {}},
        {"5", "box filter", 8, measure_filter, filter_patterns, {}},
        {"6a", "directions by the geometric term", 12, measure_cosine, cosine_patterns,
         [] { return equal_light("coursework-diffuse.json", 2, PT_ESTIMATOR_COSINE); }},
        {"6b", "lamps of very different emission", 6, measure_lamps, lamp_patterns,
         [] { return equal_light("coursework-lamps.json", 2, PT_ESTIMATOR_LIGHT); }},
        {"6c", "lamps out of the frame", 2, measure_outside, outside_patterns,
         [] { return equal_light("coursework-outside.json", 2, PT_ESTIMATOR_LIGHT); }},
        {"7", "motion", 6, measure_motion, motion_patterns,
         [] { return equal_light("coursework-motion.json", 2, PT_ESTIMATOR_LIGHT); }},
    };
    return steps;
}

CourseVerdict check_step(CourseKernels &kernels, const CourseStep &step) {
    CourseVerdict verdict = judge(step.measure(kernels), step.patterns());
    if (verdict.is_right() && step.same_light) {
        const LightVerdict light = kernels.compare(step.same_light());
        if (light.is_different())
            verdict.other_light = light.comparison.summary;
    }
    return verdict;
}

} // namespace cli
