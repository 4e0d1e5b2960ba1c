#include "cli/selftest/selftest_scenes.h"

#include "cli/base/library_error.h"
#include "cli/base/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace cli {
namespace {

using Vector = std::array<double, 3>;

// Probability that a right device fails one check: over all scenes, about one in a million.
constexpr double false_alarm = 1e-7;

// Bernstein's inequality (Boucheron, Lugosi and Massart, Concentration Inequalities, 2013, section 2.8), which holds
// for skewed samples too: for n independent samples of variance s^2 and deviations up to m,
//     P(|error| > t) <= 2 exp(-n t^2 / (2 s^2 + 2 m t / 3)).
// Solved for t. A sample that is 0, or with probability p another value, has s^2 = (1 - p) / p and deviates by s^2
// upwards and 1 downwards: m = s^2 + 6 s holds for all p up to 0.97, and leaves smooth integrands six standard
// deviations. Samples of a stratified sampler are not independent, but less noisy.
double noise_bound(double relative_std, double sample_count) {
    const double log_probability = std::log(2.0 / false_alarm);
    const double variance = relative_std * relative_std;
    const double linear = log_probability * (variance + 6.0 * relative_std) / 3.0;
    return (linear + std::sqrt(linear * linear + 2.0 * sample_count * variance * log_probability)) / sample_count;
}

// The mean of every third value.
double channel_mean(std::span<const float> radiance, std::size_t channel) {
    double sum = 0.0;
    for (std::size_t i = channel; i < radiance.size(); i += 3)
        sum += static_cast<double>(radiance[i]);
    return sum / (static_cast<double>(radiance.size()) / 3.0);
}

constexpr double unit_roundoff = 0x1p-24; // of float32: half a unit in the last place of the largest significand

// A sample is the product of some 50 operations. Vulkan's worst, the division, is off by 2.5 ulp, 5 roundoffs.
constexpr double sample_rounding = 50 * 5 * unit_roundoff;

// Full angle of a camera that looks at a point: what lies about it varies by the square of the angle, 1e-8.
constexpr double narrow = 1e-4;

double length(const Vector &v) {
    return std::hypot(v[0], v[1], v[2]);
}

pt_material grey(float diffuse, float specular, float glossiness, float emission) {
    pt_material material{};
    std::ranges::fill(material.diffuse, diffuse);
    std::ranges::fill(material.specular, specular);
    std::ranges::fill(material.emission, emission);
    material.glossiness = glossiness;
    return material;
}

pt_material emitting(double radiance) {
    return grey(0, 0, 0, static_cast<float>(radiance));
}

pt_material diffuse(float albedo) {
    return grey(albedo, 0, 0, 0);
}

pt_sphere sphere(const Vector &center, double radius, std::uint32_t material, const Vector &motion = {0, 0, 0}) {
    return {{center[0], center[1], center[2]}, radius, {motion[0], motion[1], motion[2]}, material, 0};
}

// From the origin.
pt_camera camera(const Vector &target, double vertical_fov) {
    auto camera = sized<pt_camera>();
    std::ranges::copy(target, camera.target);
    camera.vertical_fov = vertical_fov;
    return camera;
}

pt_render square(std::uint32_t side, std::uint32_t max_path_length, std::uint32_t estimator = PT_ESTIMATOR_BEST) {
    auto render = sized<pt_render>();
    render.width = side;
    render.height = side;
    render.max_path_length = max_path_length;
    render.estimator = estimator;
    return render;
}

// Emission is added as it is, to an exact sum: rounded once.
SelftestScene inside_a_lamp() {
    constexpr float radiance = 0.1F;
    return {"inside a lamp",
            {emitting(double{radiance})},
            {sphere({0, 0, 1}, 50, 0)},
            {},
            camera({0, 0, -1}, 0.9),
            square(16, 3),
            16,
            double{radiance},
            0.0,
            unit_roundoff};
}

// A white ball in a black lamp of radiance 1: every path ends on the lamp after at most one reflection of weight 1, the
// quotient of albedo / pi * cos and cos / pi: two products, three divisions, and the product with the emission.
SelftestScene white_furnace() {
    return {"white furnace",
            {emitting(1.0), diffuse(1.0F)},
            {sphere({0, 0, 1}, 50, 0), sphere({0, 0, -4}, 1, 1)},
            {},
            camera({0, 0, -1}, 0.9),
            square(16, 3, PT_ESTIMATOR_BSDF),
            16,
            1.0,
            0.0,
            (3 * 1 + 3 * 5) * unit_roundoff};
}

// The point of a diffuse floor that the camera sees. The irradiance of a uniform sphere of radius r wholly above a
// plane is that of the point at its centre with its power: pi L (r / d)^2 cos (Snyder 1996); reflected, albedo / pi
// times that. The noise: a lamp sampled by its solid angle varies with the cosine over its angle a, sin a = r / d: by
// less than sin a tan + 1 - cos a. What a direction by the cosine adds has probability p = sin^2 a cos, and a weight of
// p^2 at most.
constexpr float floor_albedo = 0.8F;
constexpr Vector floor_point{0, -1, -2};

SelftestScene floor_under_lamp(const std::string &name, const Vector &lamp, double radius, float emission) {
    const Vector way{lamp[0] - floor_point[0], lamp[1] - floor_point[1], lamp[2] - floor_point[2]};
    const double distance = length(way);
    const double cosine = way[1] / distance;
    const double sine_of_radius = radius / distance;
    const double seen = sine_of_radius * sine_of_radius * cosine;
    return {name,
            {emitting(double{emission}), diffuse(floor_albedo)},
            {sphere(lamp, radius, 0)},
            {},
            camera(floor_point, narrow),
            square(32, 2),
            64,
            double{floor_albedo} * double{emission} * seen,
            sine_of_radius * std::sqrt(1.0 / (cosine * cosine) - 1.0) + sine_of_radius * sine_of_radius + seen,
            sample_rounding};
}

constexpr pt_plane ground{{0, 1, 0}, 1, 1, 0}; // y = -1

SelftestScene lamp_above_a_floor() {
    SelftestScene scene = floor_under_lamp("lamp above a floor", {1, 3, -5}, 1, 10.0F);
    scene.planes = {ground};
    return scene;
}

SelftestScene tiny_far_lamp() {
    SelftestScene scene = floor_under_lamp("lamp of 1e-7 radians", {0, 800, -600}, 1e-4, 1e14F);
    scene.planes = {ground};
    return scene;
}

// It touches the plane's point: within the spot it departs from the plane by a part in 1e18.
SelftestScene huge_ball_as_floor() {
    constexpr double radius = 1e7;
    SelftestScene scene = floor_under_lamp("floor is a ball of 1e7", {1, 3, -5}, 1, 10.0F);
    scene.spheres.push_back(sphere({floor_point[0], floor_point[1] - radius, floor_point[2]}, radius, 1));
    return scene;
}

// A glossy floor in a dome of radiance 1. The integral of (n + 2) / (2 pi) cos^n g cos over the directions about the
// mirror direction r, where cos is to the normal and g to r, is that of the component along r, so (n + 2) / (n + 2)
// times r's own cosine. Of this lobe, 1e-3 wide, the horizon cuts nothing off. The noise: the cosine varies over the
// lobe, whose component in the plane of incidence has variance 1 / n, by tan / sqrt(n).
SelftestScene sharp_lobe() {
    constexpr double glossiness = 1e6;
    const double cosine = -floor_point[1] / length(floor_point);
    const double tangent = std::sqrt(1.0 / (cosine * cosine) - 1.0);
    return {"lobe of 1e-3 radians",
            {emitting(1.0), grey(0, 1, static_cast<float>(glossiness), 0)},
            {sphere({0, 0, 0}, 1e4, 0)},
            {ground},
            camera(floor_point, narrow),
            square(32, 2),
            64,
            cosine,
            tangent / std::sqrt(glossiness),
            sample_rounding};
}

// A lamp of radius 1 recedes along the axis, from distance a to b. It fills pi / (z^2 - 1) of the image plane at
// distance 1: on average pi / (b - a) times the integral of 1 / (z^2 - 1), which is log((z - 1) / (z + 1)) / 2, always
// within the image, a square of side 2 tan(fov / 2). The noise: a share p of the samples is 1.
SelftestScene receding_lamp() {
    constexpr double from = 4.0;
    constexpr double to = 7.0;
    constexpr double half_side = 0.26; // more than 1 / sqrt(from^2 - 1)
    const auto integral = [](double z) { return 0.5 * std::log((z - 1.0) / (z + 1.0)); };
    const double area = std::acos(-1.0) / (to - from) * (integral(to) - integral(from));
    const double share = area / (4.0 * half_side * half_side);
    return {"receding lamp",
            {emitting(1.0)},
            {sphere({0, 0, -from}, 1, 0, {0, 0, from - to})},
            {},
            camera({0, 0, -1}, 2.0 * std::atan(half_side)),
            square(64, 1),
            64,
            share,
            std::sqrt((1.0 - share) / share),
            sample_rounding};
}

// A right device fails one of the 18 checks once in a million: each with probability 5.6e-8, on both sides of a normal
// distribution, which means of 2^18 independent samples have.
constexpr double most_sigmas = 5.43;
constexpr std::uint32_t direction_image_side = 512;
constexpr double pixel_count = 1.0 * direction_image_side * direction_image_side;
constexpr int wall_count = 4;

// Of directions with density proportional to c^power.
double mean_of_power(double power, double exponent) {
    return (power + 1.0) / (power + 1.0 + exponent);
}

SelftestCheck check(const std::string &name, double measured, double exact, double variance) {
    const double error = std::abs(measured - exact) / std::sqrt(variance / pixel_count);
    return {"directions", name,    std::isfinite(error) ? error : std::numeric_limits<double>::infinity(),
            most_sigmas,  "sigma", formatted("%.9g, exact is %.9g", measured, exact)};
}

SelftestScene floor_scene(const char *name, std::uint32_t estimator, const pt_material &floor) {
    SelftestScene scene{};
    scene.name = name;
    scene.materials = {floor, emitting(1.0), diffuse(0.0F)};
    scene.spheres = {sphere({0, 0, 0}, 1000, 1)};
    scene.planes = {{{0, 1, 0}, 0, 0, 0}};
    scene.camera = camera({0, 0, 0}, 0.0);
    scene.camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    scene.camera.position[1] = 1;
    scene.camera.up[2] = 1;
    scene.camera.vertical_extent = 1e-4;
    scene.render = square(direction_image_side, 2, estimator);
    scene.render.sampler = PT_SAMPLER_RANDOM; // the pixels' numbers are independent
    scene.sample_count = 1;
    return scene;
}

} // namespace

pt_scene SelftestScene::scene() const {
    const auto size = [](const auto &items) { return static_cast<std::uint32_t>(items.size()); };
    auto scene = sized<pt_scene>();
    scene.material_count = size(materials);
    scene.sphere_count = size(spheres);
    scene.plane_count = size(planes);
    scene.materials = materials.data();
    scene.spheres = spheres.data();
    scene.planes = planes.data();
    return scene;
}

double SelftestScene::bound() const {
    const double samples = static_cast<double>(sample_count) * render.width * render.height;
    return rounding + (relative_std > 0.0 ? noise_bound(relative_std, samples) : 0.0);
}

SelftestCheck SelftestScene::judge(std::span<const float> radiance) const {
    double worst_error = 0.0;
    double worst = expected;
    const auto compare = [&](double measured) {
        const double error = std::abs(measured / expected - 1.0);
        if (!(error <= worst_error)) { // also if it is NaN
            worst_error = std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
            worst = measured;
        }
    };
    if (relative_std > 0.0)
        for (std::size_t channel = 0; channel < 3; ++channel)
            compare(channel_mean(radiance, channel));
    else
        for (const float value : radiance)
            compare(static_cast<double>(value));
    return {"scene", name, worst_error, bound(), "relative", formatted("%.9g, exact is %.9g", worst, expected)};
}

// A wall of albedo rho, a sphere of radius R, about a black lamp of radius r. A direction from the wall by the cosine
// finds the lamp with probability q = (r / R)^2, else the wall again: paths of L vertices carry
//     rho Le q sum_{j <= L - 2} (rho (1 - q))^j.
// The noise: with probability q the path ends on the lamp and lacks the rest: less than sqrt(q) of the value.
SelftestScene lamp_in_a_ball() {
    constexpr double rho = 0.5;
    constexpr double emission = 100.0;
    constexpr double q = 0.01;
    return {"lamp in a ball",
            {emitting(emission), diffuse(static_cast<float>(rho))},
            {sphere({0, 0, -3}, 1, 0), sphere({0, 0, -3}, 10, 1)},
            {},
            camera({0, 0, 1}, 0.9),
            square(16, 3),
            64,
            rho * emission * q * (1.0 + rho * (1.0 - q)),
            std::sqrt(q),
            sample_rounding};
}

std::vector<SelftestScene> selftest_scenes() {
    return {inside_a_lamp(),      white_furnace(), lamp_in_a_ball(), lamp_above_a_floor(),
            huge_ball_as_floor(), tiny_far_lamp(), sharp_lobe(),     receding_lamp()};
}

std::vector<SelftestCheck> DirectionScene::judge(std::span<const float> radiance) const {
    double sum = 0.0;
    double square_sum = 0.0;
    double seen = 0.0;
    for (std::size_t i = 0; i < radiance.size(); i += 3) {
        const double cosine = static_cast<double>(radiance[i]) / scale;
        sum += cosine;
        square_sum += cosine * cosine;
        seen += cosine > 0.0 ? 1.0 : 0.0;
    }
    if (has_wall)
        return {check(scene.name, seen / pixel_count, 0.5, 0.25)};
    const double mean = mean_of_power(power, 1.0);
    const double square = mean_of_power(power, 2.0);
    return {
        check(scene.name + ": cosine", sum / pixel_count, mean, square - mean * mean),
        check(scene.name + ": square", square_sum / pixel_count, square, mean_of_power(power, 4.0) - square * square)};
}

// With f the reflection, a sample is f * c over the density: 2 c of a white diffuse floor whose directions are uniform;
// (n + 2) / 2 c^n of a lobe of exponent n whose directions follow the cosine; (n + 2) / (n + 1) c of one that they
// follow.
std::vector<DirectionScene> direction_scenes() {
    constexpr double n = 20.0;
    const std::array open = {
        DirectionScene{floor_scene("hemisphere, uniform", PT_ESTIMATOR_UNIFORM, grey(1, 0, 0, 0)), 0.0, 2.0, false},
        DirectionScene{floor_scene("hemisphere, by cosine", PT_ESTIMATOR_COSINE, grey(0, 1, 1, 0)), 1.0, 1.5, false},
        DirectionScene{floor_scene("Phong lobe, n = 20", PT_ESTIMATOR_BSDF, grey(0, 1, static_cast<float>(n), 0)), n,
                       (n + 2.0) / (n + 1.0), false}};
    std::vector<DirectionScene> scenes;
    for (const DirectionScene &kind : open) {
        scenes.push_back(kind);
        for (int wall = 0; wall < wall_count; ++wall) {
            const double angle = std::numbers::pi * wall / wall_count;
            DirectionScene walled = kind;
            walled.has_wall = true;
            walled.scene.name += ": side " + std::to_string(180 * wall / wall_count);
            walled.scene.planes.push_back({{std::cos(angle), 0, std::sin(angle)}, 1, 2, 0});
            scenes.push_back(walled);
        }
    }
    return scenes;
}

} // namespace cli
