// The scenes of `pt selftest`: few and small, each with a closed form. They look for what may be wrong on a single
// device: other roundings, lamps of extreme sizes, lobes of extreme sharpness, motion.
#include "cli/selftest/selftest_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cli {
namespace {

constexpr double unit_roundoff = 0x1p-24; // of float32: half a unit in the last place of the largest significand

// A sample is the product of some 50 operations. Vulkan's worst, the division, is off by 2.5 ulp, 5 roundoffs.
constexpr double sample_rounding = 50 * 5 * unit_roundoff;

// Full angle of a camera that looks at a point: what lies about it varies by the square of the angle, 1e-8.
constexpr double narrow = 1e-4;

using Vector = std::array<double, 3>;

double length(const Vector &v) {
    return std::hypot(v[0], v[1], v[2]);
}

pt_material emitting(double radiance) {
    pt_material material{};
    std::ranges::fill(material.emission, static_cast<float>(radiance));
    return material;
}

pt_material diffuse(float albedo) {
    pt_material material{};
    std::ranges::fill(material.diffuse, albedo);
    return material;
}

pt_material glossy(float specular, float glossiness) {
    pt_material material{};
    std::ranges::fill(material.specular, specular);
    material.glossiness = glossiness;
    return material;
}

pt_sphere sphere(const Vector &center, double radius, std::uint32_t material, const Vector &motion = {0, 0, 0}) {
    return {{center[0], center[1], center[2]}, radius, {motion[0], motion[1], motion[2]}, material, 0};
}

// From the origin.
pt_camera camera(const Vector &target, double vertical_fov) {
    pt_camera camera{};
    camera.struct_size = sizeof(pt_camera);
    std::ranges::copy(target, camera.target);
    camera.vertical_fov = vertical_fov;
    return camera;
}

pt_render square(std::uint32_t side, std::uint32_t max_path_length, std::uint32_t estimator = PT_ESTIMATOR_BEST) {
    pt_render render{};
    render.struct_size = sizeof(pt_render);
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

} // namespace

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

namespace {

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
            {emitting(1.0), glossy(1.0F, static_cast<float>(glossiness))},
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

} // namespace

std::vector<SelftestScene> selftest_scenes() {
    return {inside_a_lamp(),      white_furnace(), lamp_in_a_ball(), lamp_above_a_floor(),
            huge_ball_as_floor(), tiny_far_lamp(), sharp_lobe(),     receding_lamp()};
}

} // namespace cli
