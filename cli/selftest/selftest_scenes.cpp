#include "cli/selftest/selftest.h"

#include "cli/base/text.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace cli {
namespace {

// Probability that one check fails on a correct device. All checks together fail with about 1e-6.
constexpr double false_alarm = 1e-7;

// Bernstein's inequality (Boucheron, Lugosi, Massart, Concentration Inequalities, 2013, section 2.8): P(|error| > t) <=
// 2 exp(-n t^2 / (2 s^2 + 2 m t / 3)) for the mean of n independent samples of mean 1, variance s^2 and deviations up
// to m. The bound is the solution for t. Samples that are nonzero with probability p have s^2 = (1 - p) / p and m =
// max(s^2, 1) <= s^2 + 6 s for p <= 0.97. Stratified samples have less noise.
double noise_bound(double relative_std, double sample_count) {
    const double log_probability = std::log(2.0 / false_alarm);
    const double variance = relative_std * relative_std;
    const double linear = log_probability * (variance + 6.0 * relative_std) / 3.0;
    return (linear + std::sqrt(linear * linear + 2.0 * sample_count * variance * log_probability)) / sample_count;
}

double channel_mean(std::span<const float> radiance, std::size_t channel, int power) {
    double sum = 0.0;
    for (std::size_t i = channel; i < radiance.size(); i += 3)
        sum += radiance[i] == 0.0F ? 0.0 : std::pow(static_cast<double>(radiance[i]), power);
    return sum / (static_cast<double>(radiance.size()) / 3.0);
}

SceneFile scene_of(std::uint32_t side, std::uint32_t sample_count, const std::string &members) {
    return parse_scene(concat(R"({"film": {"width": )", side, R"(, "height": )", side, R"(}, "render": {"spp": )",
                              sample_count, members, "}"),
                       "");
}

// The emission is added to an exact sum, which is rounded once.
SelftestScene inside_a_lamp() {
    const SceneFile scene = scene_of(16, 16, R"(, "max_path_length": 3}, "materials": {"lamp": {"emission": 0.1}},
        "spheres": [{"center": [0, 0, 2], "radius": 50, "material": "lamp"}])");
    return {"inside a lamp", scene, double{scene.materials[0].emission[0]}, 0.0, unit_roundoff};
}

// A white ball in a black lamp of radiance 1. Each path ends on the lamp after at most one reflection. The weight
// (albedo / pi * cos) / (cos / pi) has two products and three divisions, and the emission adds a third product.
SelftestScene white_furnace() {
    const SceneFile scene = scene_of(16, 16, R"(, "max_path_length": 3, "estimator": "bsdf"},
        "materials": {"lamp": {"emission": 1}, "white": {"diffuse": 1}},
        "spheres": [{"center": [0, 0, 2], "radius": 50, "material": "lamp"},
                    {"center": [0, 0, -3], "radius": 1, "material": "white"}])");
    return {"white furnace", scene, 1.0, 0.0, (3 * 1 + 3 * 5) * unit_roundoff};
}

// The view is so narrow that the light varies by 1e-8.
SceneFile floor_scene(const std::string &members, std::uint32_t side = 32, std::uint32_t sample_count = 64,
                      std::uint32_t max_path_length = 2) {
    return scene_of(side, sample_count, concat(R"(, "max_path_length": )", max_path_length, R"(},
        "camera": {"position": [0, 0, 0], "look_at": [0, -1, -2], "vertical_fov": 0.0057}, )" + members));
}

struct SeenLamp {
    double cosine; // cosine of the direction to the center
    double sine;   // sine of the angular radius
};

SeenLamp lamp_seen(const pt_sphere &lamp, const pt_camera &camera) {
    std::array<double, 3> way{};
    for (std::size_t i = 0; i < 3; ++i)
        way[i] = lamp.center[i] - camera.target[i];
    const double distance = std::hypot(way[0], way[1], way[2]);
    return {way[1] / distance, lamp.radius / distance};
}

// A sphere above a plane gives the radiance A L (r / d)^2 cos b, as a point would (Snyder 1996). b is the angle of the
// lamp to the normal, and sin a = r / d. For directions by solid angle, the relative deviation is below sin a tan b +
// 1 - cos a. Directions by the cosine hit the lamp with probability p = sin^2 a cos b, and their weight is at most p^2.
SelftestScene floor_under_lamp(const std::string &name, const std::string &members) {
    const SceneFile scene = floor_scene(members);
    const auto [cosine, sine] = lamp_seen(scene.spheres[0], scene.camera);
    const double share = sine * sine * cosine;
    return {name, scene, double{scene.materials[1].diffuse[0]} * double{scene.materials[0].emission[0]} * share,
            sine * std::sqrt(1.0 / (cosine * cosine) - 1.0) + sine * sine + share, sample_rounding};
}

SelftestScene lamp_above_a_floor() {
    return floor_under_lamp("lamp above a floor", R"(
        "materials": {"lamp": {"emission": 10}, "floor": {"diffuse": 0.8}},
        "spheres": [{"center": [1, 3, -5], "radius": 1, "material": "lamp"}],
        "planes": [{"normal": [0, 1, 0], "offset": 1, "material": "floor"}])");
}

SelftestScene tiny_far_lamp() {
    return floor_under_lamp("lamp of 1e-7 radians", R"(
        "materials": {"lamp": {"emission": 1e14}, "floor": {"diffuse": 0.8}},
        "spheres": [{"center": [0, 800, -600], "radius": 1e-4, "material": "lamp"}],
        "planes": [{"normal": [0, 1, 0], "offset": 1, "material": "floor"}])");
}

// Ball and plane differ by 1e-18 within the view.
SelftestScene huge_ball_as_floor() {
    return floor_under_lamp("floor is a ball of 1e7", R"(
        "materials": {"lamp": {"emission": 10}, "floor": {"diffuse": 0.8}},
        "spheres": [{"center": [1, 3, -5], "radius": 1, "material": "lamp"},
                    {"center": [0, -10000001, -2], "radius": 1e7, "material": "floor"}])");
}

// A glossy floor in a dome of radiance 1. Let g be the angle between a direction and the mirror direction r. The
// integral of (n + 2) / (2 pi) cos^n(g) times the direction's cosine is the cosine of r, because only components along
// r contribute. The horizon does not clip the lobe. Directions in the plane of incidence have the variance 1 / n. So a
// sample's cosine has the relative standard deviation tan(a) / sqrt(n) at the angle of incidence a.
SelftestScene sharp_lobe() {
    const SceneFile scene = floor_scene(R"(
        "materials": {"dome": {"emission": 1}, "floor": {"specular": 1, "glossiness": 1e6}},
        "spheres": [{"center": [0, 0, 0], "radius": 1e4, "material": "dome"}],
        "planes": [{"normal": [0, 1, 0], "offset": 1, "material": "floor"}])");
    constexpr double tangent = 2.0; // tangent of the angle of incidence
    return {"lobe of 1e-3 radians", scene, 1.0 / std::sqrt(1.0 + tangent * tangent),
            tangent / std::sqrt(double{scene.materials[1].glossiness}), sample_rounding};
}

// A unit lamp moves along the axis from a to b. It covers f(z) = pi / (z^2 - 1) of the image plane.
// With F(z) = pi log((z - 1) / (z + 1)) / 2, the integral of f, the average is (F(b) - F(a)) / (b - a).
// The lamp is always fully in view: 2 tan(fov / 2) > 2 / sqrt(a^2 - 1).
SelftestScene receding_lamp() {
    const SceneFile scene = scene_of(64, 64, R"(, "max_path_length": 1}, "materials": {"lamp": {"emission": 1}},
        "camera": {"position": [0, 0, 0], "look_at": [0, 0, -1], "vertical_fov": 29.2},
        "spheres": [{"center": [0, 0, -4], "radius": 1, "motion": [0, 0, -3], "material": "lamp"}])");
    const double from = -scene.spheres[0].center[2];
    const double to = from - scene.spheres[0].motion[2];
    const double half_side = std::tan(0.5 * scene.camera.vertical_fov);
    const auto integral = [](double z) { return 0.5 * std::log((z - 1.0) / (z + 1.0)); };
    const double area = std::numbers::pi / (to - from) * (integral(to) - integral(from));
    const double share = area / (4.0 * half_side * half_side);
    return {"receding lamp", scene, share, std::sqrt((1.0 - share) / share), sample_rounding};
}

// The standard deviations of the next three scenes come from quadrature and are rounded up. The bounds are below 1% of
// the smallest contribution of a weight.

// The lamp fills a cone of 30 degrees. Four directions together have almost the same density as the lamp's sample, so
// each technique contributes half of the value.
SelftestScene weights_of_a_lamp() {
    const SceneFile scene = floor_scene(R"(
        "materials": {"lamp": {"emission": 4}, "floor": {"diffuse": 1}},
        "spheres": [{"center": [0, 1, -2], "radius": 1, "material": "lamp"}],
        "planes": [{"normal": [0, 1, 0], "offset": 1, "material": "floor"}])",
                                        64, 128, 3);
    const double sine = lamp_seen(scene.spheres[0], scene.camera).sine;
    return {"weights of a lamp", scene, 4.0 * sine * sine, 0.45, sample_rounding};
}

// The floor chooses one of five lamps in a ring.
SelftestScene weights_of_a_chosen_lamp() {
    constexpr int lamp_count = 5;
    constexpr double polar = 50.0 / 180.0 * std::numbers::pi;
    std::string lamps;
    for (int i = 0; i < lamp_count; ++i) {
        const double azimuth = 2.0 * std::numbers::pi * (i + 0.5) / lamp_count;
        lamps += concat(i == 0 ? "" : ", ", R"({"center": [)", 5.0 * std::sin(polar) * std::sin(azimuth), ", ",
                        5.0 * std::cos(polar) - 1.0, ", ", 5.0 * std::sin(polar) * std::cos(azimuth) - 2.0,
                        R"(], "radius": 2.1, "material": "lamp"})");
    }
    const SceneFile scene = floor_scene(concat(R"(
        "materials": {"lamp": {"emission": 1}, "floor": {"diffuse": 1}}, "spheres": [)",
                                               lamps, R"(],
        "planes": [{"normal": [0, 1, 0], "offset": 1, "material": "floor"}])"),
                                        64, 128);
    double expected = 0.0;
    for (const pt_sphere &lamp : scene.spheres) {
        const auto [cosine, sine] = lamp_seen(lamp, scene.camera);
        expected += sine * sine * cosine;
    }
    return {"weights of a chosen lamp", scene, expected, 0.3, sample_rounding};
}

// A lamp of radiance L and radius r hangs h below a ceiling of albedo A. The ceiling is H above the floor. Straight
// below, the floor gets L r^2 / (H - h)^2 from the lamp. The ceiling gives L r^2 A 2 h H^2 int_h^inf dv / (v^2 (v^2 +
// a^2)^2) with a^2 = H^2 - h^2, from points at distances v from the lamp.
SelftestScene weights_of_a_glow() {
    constexpr double albedo = 20.0;
    constexpr double h = 1.0;
    constexpr double H = 6.5;
    const SceneFile scene = floor_scene(R"(
        "materials": {"lamp": {"emission": 1e6}, "floor": {"diffuse": 1}, "ceiling": {"diffuse": 20}},
        "spheres": [{"center": [0, 4.5, -2], "radius": 1e-3, "material": "lamp"}],
        "planes": [{"normal": [0, 1, 0], "offset": 1, "material": "floor"},
                   {"normal": [0, -1, 0], "offset": 5.5, "material": "ceiling"}])",
                                        64, 256, 3);
    const double a = std::sqrt(H * H - h * h);
    const double integral = (1.0 / h - 1.5 * std::atan(a / h) / a + 0.5 * h / (H * H)) / (a * a * a * a);
    return {"weights of a glow", scene, 1.0 / ((H - h) * (H - h)) + albedo * 2.0 * h * H * H * integral, 0.4,
            sample_rounding};
}

struct DirectionKind {
    const char *name;
    const char *estimator;
    const char *floor; // members of its material
    double power;      // the density is c^power, where c is the cosine to the normal
    double scale;      // a sample is scale * c
};

// A floor under a sky of radiance 1, seen from above by parallel rays, with one independent sample per pixel. `share`
// is the fraction of directions that more_planes leave free, which is the same for any cosine.
SelftestScene direction_scene(const DirectionKind &kind, const std::string &what, int exponent,
                              const std::string &more_planes, double share) {
    const auto moment = [&](int e) {
        return share * std::pow(kind.scale, e) * (kind.power + 1.0) / (kind.power + 1.0 + e);
    };
    const double mean = moment(exponent);
    const SceneFile scene =
        scene_of(512, 1,
                 concat(R"(, "max_path_length": 2, "sampler": "random", "estimator": ")", kind.estimator, R"("},
        "camera": {"projection": "orthographic", "position": [0, 1, 0], "look_at": [0, 0, 0], "up": [0, 0, 1],
                   "vertical_extent": 1e-4},
        "materials": {"floor": {)",
                        kind.floor, R"(}, "sky": {"emission": 1}, "black": {}},
        "spheres": [{"center": [0, 0, 0], "radius": 1000, "material": "sky"}],
        "planes": [{"normal": [0, 1, 0], "offset": 0, "material": "floor"})",
                        more_planes, "]"));
    return {kind.name + what, scene,   mean, std::sqrt(moment(2 * exponent) / (mean * mean) - 1.0),
            sample_rounding,  exponent};
}

} // namespace

double SelftestScene::bound() const {
    const double samples = static_cast<double>(scene.sample_count.value()) * scene.render.width * scene.render.height;
    return rounding + (relative_std > 0.0 ? noise_bound(relative_std, samples) : 0.0);
}

SelftestCheck SelftestScene::judge(std::span<const float> radiance) const {
    double worst_error = 0.0;
    double worst = expected;
    const auto compare = [&](double measured) {
        const double error = std::abs(measured / expected - 1.0);
        if (!(error <= worst_error)) { // also for NaN
            worst_error = std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
            worst = measured;
        }
    };
    if (relative_std > 0.0)
        for (std::size_t channel = 0; channel < 3; ++channel)
            compare(channel_mean(radiance, channel, power));
    else
        for (const float value : radiance)
            compare(static_cast<double>(value));
    return {"scene", name, worst_error, bound(), "relative", formatted("%.9g, exact is %.9g", worst, expected)};
}

// A wall of albedo rho and radius R around a black lamp of radius r. Directions by the cosine hit the lamp with
// probability q = (r / R)^2. Paths of L vertices carry rho Le q sum_{j <= L - 2} (rho (1 - q))^j. A path that ends on
// the lamp lacks the rest of the sum, which adds less than sqrt(q) to the relative standard deviation.
SelftestScene lamp_in_a_ball() {
    constexpr double rho = 0.5;
    constexpr double emission = 100.0;
    constexpr double q = 0.01;
    const SceneFile scene = scene_of(16, 64, R"(, "max_path_length": 3},
        "camera": {"position": [0, 0, 0], "look_at": [0, 0, 1]},
        "materials": {"lamp": {"emission": 100}, "wall": {"diffuse": 0.5}},
        "spheres": [{"center": [0, 0, -3], "radius": 1, "material": "lamp"},
                    {"center": [0, 0, -3], "radius": 10, "material": "wall"}])");
    return {"lamp in a ball", scene, rho * emission * q * (1.0 + rho * (1.0 - q)), std::sqrt(q), sample_rounding};
}

std::vector<SelftestScene> selftest_scenes() {
    return {inside_a_lamp(),      white_furnace(), lamp_in_a_ball(), lamp_above_a_floor(),
            huge_ball_as_floor(), tiny_far_lamp(), sharp_lobe(),     receding_lamp()};
}

std::vector<SelftestScene> weight_scenes() {
    return {weights_of_a_lamp(), weights_of_a_chosen_lamp(), weights_of_a_glow()};
}

// A sample is reflection * c / density. This is 2 c for white diffuse and uniform directions, (n + 2) / 2 c^n for a
// lobe by the cosine, and (n + 2) / (n + 1) c for a lobe by its own density. A black plane beside the rays blocks half
// of the directions.
std::vector<SelftestScene> direction_scenes() {
    constexpr double n = 20.0;
    constexpr int wall_count = 4;
    std::vector<SelftestScene> scenes;
    for (const DirectionKind &kind : {
             DirectionKind{"hemisphere, uniform", "uniform", R"("diffuse": 1)", 0.0, 2.0},
             DirectionKind{"hemisphere, by cosine", "cosine", R"("specular": 1, "glossiness": 1)", 1.0, 1.5},
             DirectionKind{"Phong lobe, n = 20", "bsdf", R"("specular": 1, "glossiness": 20)", n,
                           (n + 2.0) / (n + 1.0)},
         }) {
        scenes.push_back(direction_scene(kind, ": cosine", 1, "", 1.0));
        scenes.push_back(direction_scene(kind, ": square", 2, "", 1.0));
        for (int wall = 0; wall < wall_count; ++wall) {
            const double angle = std::numbers::pi * wall / wall_count;
            const std::string plane = concat(R"(, {"normal": [)", std::cos(angle), ", 0, ", std::sin(angle),
                                             R"(], "offset": 1, "material": "black"})");
            scenes.push_back(direction_scene(kind, concat(": side ", 180 * wall / wall_count), 0, plane, 0.5));
        }
    }
    return scenes;
}

} // namespace cli
