#include "cli/course/step_parts.h"
#include "cli/course/step_values.h"

#include <cmath>
#include <numbers>

namespace cli {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr std::uint32_t ball_length = 4;

double no_weight_below(double cosine, double weight) {
    return cosine > 0.0 ? weight : 0.0;
}

} // namespace

std::vector<Measured> measure_directions(CourseKernels &kernels) {
    std::vector<Measured> measured = floor_means(kernels, PT_ESTIMATOR_UNIFORM);
    measured.push_back(kernels.edited(glowing_ball(ball_length)).mean("paths in a glowing ball", 0));
    const Picture floor = kernels.edited(floor_below_a_lamp());
    measured.push_back(floor.mean("floor below a near lamp, red", 0));
    measured.push_back(floor.mean("its own light, blue", 2));
    return measured;
}

std::vector<Pattern> direction_patterns() {
    const Weight one = [](double cosine) { return no_weight_below(cosine, 1.0); };
    const Channels angles = lamp_solid_angles();
    const Channels shares{angles[0] / two_pi, 2.0 * angles[1] / two_pi, 2.0 * angles[2] / two_pi};
    const auto sum = [](double albedo, int vertices) {
        double light = 0.0;
        for (int vertex = 0; vertex < vertices; ++vertex)
            light += std::pow(albedo, vertex);
        return nearly(light); // grazing directions leave through the wall that they start on
    };
    const Range own_light{1.0, 1.001}; // rounding lets few grazing rays hit the floor
    std::vector<Pattern> patterns;
    for (const bool has_throughput : {false, true}) {
        const double albedo = has_throughput ? 0.5 : 1.0;
        const Weight weight = has_throughput ? scaled_cosine(2.0) : one;
        const Channels right = has_throughput ? right_lamplight() : shares;
        const double below = has_throughput ? near_lamp_square_sine : 1.0 - std::sqrt(1.0 - near_lamp_square_sine);
        const Range paths = sum(albedo, ball_length);
        const auto add = [&](const char *name, const char *hint, const Values &lamps, Range ball, Range lamp,
                             Range own) {
            patterns.push_back({name, hint, joined(lamps, {ball, lamp, own})});
        };
        add("", "", exact(right), paths, exactly(below), own_light);
        add("abs(z)", "The half above a surface depends on its normal: turn directions with a negative cosine round.",
            near(lamplight(absolute_z, weight)), any_value, any_value, any_value);
        add("directions of the whole sphere", "Turn directions below the surface round.",
            near(lamplight(unturned, weight)), any_value, any_value, any_value);
        add("paths one vertex short", "The camera's ray hits vertex 1, so there are MAX_PATH_LENGTH vertices.",
            exact(right, 0.0), sum(albedo, ball_length - 1), exactly(0.0), own_light);
        add("paths one vertex long", "The camera's ray hits vertex 1, so there are MAX_PATH_LENGTH vertices.",
            any_values(3), sum(albedo, ball_length + 1), any_value, any_value);
        for (const Range &lamp : {Range{0.0, 0.95 * below}, Range{1.05 * below, infinity}})
            add("rays start elsewhere", "A reflected ray's origin is the position of the hit.", exact(right), any_value,
                lamp, own_light);
    }
    patterns.push_back({"no bounces", "Continue the path from each surface.",
                        joined(exact({0.0, 0.0, 0.0}), {exactly(1.0), exactly(0.0), own_light})});
    patterns.push_back({"self-intersection", "Skip intersections nearer than NEAR on the surface that a ray leaves.",
                        joined(any_values(5), {{1.01, infinity}})});
    return patterns;
}

std::vector<Measured> measure_throughput(CourseKernels &kernels) {
    std::vector<Measured> measured = means(kernels.edited(floor_under_the_sky()), "floor under a sky");
    for (const Measured &mean : floor_means(kernels, PT_ESTIMATOR_UNIFORM))
        measured.push_back(mean);
    return measured;
}

std::vector<Measured> measure_lobe(CourseKernels &kernels) {
    std::vector<Measured> measured = means(kernels.edited(lamps_above_a_glossy_floor()), "glossy floor");
    measured.insert(measured.begin(), ball_mean(kernels, PT_ESTIMATOR_UNIFORM));
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
    const char *no_mirror = "lobe without mirror";
    const char *to_mirror = "The lobe is about reflect(ray.direction, normal), the direction of a mirror.";
    std::vector<Pattern> patterns{
        scaled("", "", 1.0),
        scaled("missing 2 pi",
               "Divide the light of a direction by its density, which is 1 / (2 pi) for uniform directions.",
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
        {"throughput of the last surface alone", "The throughput is a product: multiply it instead of replacing it.",
         joined({exactly(1.0), exactly(1.0), exactly(1.0)}, joined(exact(lamps), {exactly(50.0 * q * (1.0 + c))}))},
        {"no throughput", "Multiply emission by the throughput of the path that leads to it.",
         joined({exactly(1.0), exactly(1.0), exactly(1.0)},
                joined(near(lamplight(to_the_normals_side, [](double) { return 1.0; })), {exactly(100.0 * q)}))},
        {"emission counted twice", "Each vertex adds its emission once.",
         joined({any_value, any_value, exactly(2.0)}, any_values(4))},
        {"self-intersection", "Skip intersections nearer than NEAR on the surface that a ray leaves.",
         joined({any_value, any_value, {1.0001, 1.9}}, any_values(4))},
        {"abs(z)", "The half above a surface depends on its normal: turn directions with a negative cosine round.",
         joined(any_values(3), joined(near(lamplight(absolute_z, scaled_cosine(2.0))), {any_value}))},
        {no_mirror, to_mirror, joined({exactly(1.0), exactly(0.0), exactly(1.0)}, joined(exact(lamps), {any_value}))}};
    const std::size_t before = patterns.front().values.size();
    for (Pattern &pattern : patterns)
        pattern.values = joined(pattern.values, pattern.is_right() ? near(gloss_of_lamps(mirrored)) : any_values(3));
    for (const Turn &axis : {Turn(turned_back), Turn(along_normal)})
        patterns.push_back({no_mirror, to_mirror, joined(any_values(before), near(gloss_of_lamps(axis)))});
    return patterns;
}

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

std::vector<Measured> measure_uniform_beside(CourseKernels &kernels) {
    const Picture picture = kernels.edited(floor_under_the_sky());
    return {{"the same, uniform", picture.deviation(0) / picture.mean("", 0).value, 0.01}};
}

std::vector<Pattern> cosine_patterns() {
    const Channels right = right_lamplight();
    const Range noise{0.5 * std::sqrt(1.0 / 3.0), infinity};
    return {{"", "", joined(exact(right), {exactly(1.0), exactly(0.0), noise})},
            {"directions are still uniform", "With the estimator cosine the density must be cosine / pi.",
             joined(exact(right), {exactly(1.0), exactly(std::sqrt(1.0 / 3.0)), any_value})},
            {"cosine twice", "The density cosine / pi cancels the geometric term, which still counts here.",
             joined(near(lamplight(to_the_normals_side, [](double x) { return 4.0 * x * x; })),
                    {exactly(4.0 / 3.0), exactly(std::sqrt(1.0 / 8.0)), any_value})},
            {"cosine cancelled, directions uniform", "Leave the geometric term out only if the density has it.",
             joined(near(lamplight(to_the_normals_side, [](double) { return 1.0; })),
                    {exactly(1.0), exactly(0.0), any_value})},
            {"2 pi instead of pi", "The density is cosine / pi: cosines are 1/2 in the mean over a hemisphere.",
             joined(exact(right, 2.0), {exactly(2.0), exactly(0.0), any_value})},
            {"ESTIMATOR is ignored",
             "ESTIMATOR_UNIFORM keeps uniform directions, so that both pictures can be compared.",
             joined(exact(right), {exactly(1.0), exactly(0.0), exactly(0.0)})}};
}

} // namespace cli
