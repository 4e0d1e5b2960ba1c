#include "cli/course/course_scene.h"

#include "cli/base/text.h"
#include "cli/course/course_files.h"
#include "cli/selftest/selftest.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cli {
namespace {

constexpr double pi = std::numbers::pi;

struct FloorLamp {
    glm::dvec3 direction;
    double half_angle;
    std::size_t channel;
};

const glm::dvec3 floor_normal = glm::dvec3(1.0, 2.0, 2.0) / 3.0;

// All lamps lie above the floor and apart from each other.
std::array<FloorLamp, 5> floor_lamps() {
    constexpr double polar = 56.0 / 180.0 * pi;
    constexpr double beside = 25.0 / 180.0 * pi;
    const glm::dvec3 x = glm::normalize(glm::dvec3(0.0, 1.0, -1.0));
    const glm::dvec3 y = glm::cross(floor_normal, x);
    const auto tilted = [&](const glm::dvec3 &way) { return std::cos(polar) * floor_normal + std::sin(polar) * way; };
    return {{{floor_normal, pi / 6.0, 0},
             {tilted(x), beside, 1},
             {tilted(y), beside, 1},
             {tilted(-x), beside, 2},
             {tilted(-y), beside, 2}}};
}

std::string numbers(const glm::dvec3 &point) {
    return formatted("[%.17g, %.17g, %.17g]", point.x, point.y, point.z);
}

SceneFile course_floor(std::uint32_t side, std::uint32_t sample_count, const glm::dvec3 &position,
                       const std::string &members) {
    return parse_scene(concat(R"({"film": {"width": )", side, R"(, "height": )", side, R"(}, "render": {"spp": )",
                              sample_count,
                              R"(, "max_path_length": 2, "sampler": "random", "estimator": "uniform"},
        "camera": {"projection": "orthographic", "position": )",
                              numbers(position),
                              R"(, "look_at": [0, 0, 0], "up": [0, 0, 1], "vertical_extent": 1e-4}, )", members, "}"),
                       "");
}

SceneFile lamps_above(std::uint32_t side, std::uint32_t sample_count, const glm::dvec3 &camera, const char *floor) {
    constexpr double distance = 10.0;
    constexpr std::array<const char *, 3> colors{"red", "green", "blue"};
    std::string spheres;
    for (const FloorLamp &lamp : floor_lamps())
        spheres += concat(spheres.empty() ? "" : ", ", R"({"center": )", numbers(distance * lamp.direction),
                          R"(, "radius": )", formatted("%.17g", distance * std::sin(lamp.half_angle)),
                          R"(, "material": ")", colors.at(lamp.channel), "\"}");
    return course_floor(side, sample_count, camera,
                        concat(R"(
        "materials": {"floor": )",
                               floor, R"(, "red": {"emission": [1, 0, 0]}, "green": {"emission": [0, 1, 0]},
                      "blue": {"emission": [0, 0, 1]}},
        "spheres": [)",
                               spheres, R"(],
        "planes": [{"normal": )",
                               numbers(floor_normal), R"(, "offset": 0, "material": "floor"}])"));
}

void add_light(Channels &light, const glm::dvec3 &direction, double weight) {
    for (const FloorLamp &lamp : floor_lamps())
        if (glm::dot(direction, lamp.direction) > std::cos(lamp.half_angle))
            light[lamp.channel] += weight;
}

// Spherical Fibonacci lattice (Swinbank and Purser 2006).
glm::dvec3 lattice_direction(int i, int count) {
    const double height = 1.0 - (2.0 * i + 1.0) / count;
    const double angle = 2.0 * pi * i / std::numbers::phi;
    const double radius = std::sqrt(1.0 - height * height);
    return {radius * std::cos(angle), radius * std::sin(angle), height};
}

constexpr double ball_share = 0.01; // (r / R)^2 of lamp_in_a_ball()

// The ball's center has height 1.
constexpr double ball_begin = -1.5;
constexpr double ball_motion = 2.0;
constexpr double ball_radius = 0.8;
constexpr double overhead_half_angle = pi / 12.0;
const glm::dvec3 ball_camera(-std::sin(pi / 3.0), std::cos(pi / 3.0), 0.0); // direction to the camera

constexpr std::uint32_t disc_side = 32;
constexpr glm::dvec2 disc_center{-2.2, -1.05};
constexpr glm::dvec2 disc_motion{5.0, 2.5};

} // namespace

SceneFile lamps_above_a_floor(std::uint32_t side, std::uint32_t sample_count) {
    return lamps_above(side, sample_count, floor_normal, R"({"diffuse": 1})");
}

SceneFile lamps_above_a_glossy_floor() {
    return lamps_above(32, 64, floor_lamps()[1].direction, R"({"specular": 1, "glossiness": 8})");
}

glm::dvec3 to_the_normals_side(const glm::dvec3 &direction, const glm::dvec3 &normal) {
    return glm::dot(direction, normal) < 0.0 ? -direction : direction;
}

glm::dvec3 absolute_z(const glm::dvec3 &direction, const glm::dvec3 &) {
    return {direction.x, direction.y, std::abs(direction.z)};
}

glm::dvec3 unturned(const glm::dvec3 &direction, const glm::dvec3 &) {
    return direction;
}

Channels lamplight(const Turn &turn, const Weight &weight) {
    constexpr int count = 1 << 16;
    Channels light{};
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 direction = turn(lattice_direction(i, count), floor_normal);
        add_light(light, direction, weight(glm::dot(direction, floor_normal)) / count);
    }
    return light;
}

glm::dvec3 mirrored(const glm::dvec3 &ray, const glm::dvec3 &normal) {
    return glm::reflect(ray, normal);
}

glm::dvec3 turned_back(const glm::dvec3 &ray, const glm::dvec3 &) {
    return -ray;
}

glm::dvec3 along_normal(const glm::dvec3 &, const glm::dvec3 &normal) {
    return normal;
}

Channels gloss_of_lamps(const Turn &axis_of) {
    constexpr int count = 1 << 16;
    const glm::dvec3 axis = axis_of(-floor_lamps()[1].direction, floor_normal);
    Channels light{};
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 direction = to_the_normals_side(lattice_direction(i, count), floor_normal);
        const double lobe = std::pow(std::max(glm::dot(direction, axis), 0.0), floor_glossiness);
        add_light(light, direction, (floor_glossiness + 2.0) * lobe * glm::dot(direction, floor_normal) / count);
    }
    return light;
}

Channels lamp_solid_angles() {
    Channels angles{};
    for (const FloorLamp &lamp : floor_lamps())
        angles[lamp.channel] = 2.0 * pi * (1.0 - std::cos(lamp.half_angle));
    return angles;
}

Channels right_lamplight() {
    Channels light{};
    for (const FloorLamp &lamp : floor_lamps())
        light[lamp.channel] += std::pow(std::sin(lamp.half_angle), 2) * glm::dot(lamp.direction, floor_normal);
    return light;
}

SceneFile floor_under_the_sky() {
    return course_floor(512, 1, floor_normal,
                        concat(R"(
        "materials": {"floor": {"diffuse": [1, 0, 0.5], "specular": [0, 1, 0], "glossiness": 8, "emission": [0, 0, 1]},
                      "sky": {"emission": [1, 1, 0]}},
        "spheres": [{"center": [0, 0, 0], "radius": 1000, "material": "sky"},
                    {"center": [5, 10, 10], "radius": 0.02, "material": "sky"}],
        "planes": [{"normal": )",
                               numbers(floor_normal), R"(, "offset": 0, "material": "floor"}])"));
}

SceneFile floor_below_a_lamp() {
    return parse_scene(R"({"film": {"width": 32, "height": 32}, "render": {"spp": 64, "max_path_length": 2,
                      "sampler": "random", "estimator": "uniform"},
        "camera": {"position": [1.6, 1.2, 0], "look_at": [0, 0, 0], "vertical_fov": 0.2},
        "materials": {"floor": {"diffuse": 1, "emission": [0, 0, 1]}, "lamp": {"emission": [1, 0, 0]}},
        "spheres": [{"center": [0, 0.8, 0], "radius": 0.5, "material": "lamp"}],
        "planes": [{"normal": [0, 1, 0], "offset": 0, "material": "floor"}]})",
                       "");
}

double ball_cosine() {
    return std::sqrt(1.0 - ball_share);
}

double light_in_a_ball(double hit, double missed, int vertices) {
    constexpr double rho = 0.5;
    constexpr double emission = 100.0;
    double light = 0.0;
    double throughput = rho;
    for (int vertex = 2; vertex <= vertices; ++vertex) {
        light += emission * throughput * hit;
        throughput *= rho * missed;
    }
    return light;
}

SceneFile glowing_ball(std::uint32_t max_path_length) {
    return parse_scene(concat(R"({"film": {"width": 32, "height": 32}, "render": {"spp": 32, "max_path_length": )",
                              max_path_length, R"(, "sampler": "random", "estimator": "uniform"},
        "camera": {"position": [0, 0, 0], "look_at": [0, 0, 1]},
        "materials": {"wall": {"diffuse": 0.5, "emission": 1}},
        "spheres": [{"center": [0, 0, -3], "radius": 10, "material": "wall"}]})"),
                       "");
}

SceneFile shadow() {
    return course_floor(16, 16, {0.0, 1.0, 0.0}, R"(
        "materials": {"floor": {"diffuse": 1}, "lamp": {"emission": 1}, "black": {}},
        "spheres": [{"center": [0, 8, 0], "radius": 1, "material": "lamp"},
                    {"center": [0, 4, 0], "radius": 1, "material": "black"}],
        "planes": [{"normal": [0, 1, 0], "offset": 0, "material": "floor"}])");
}

SceneFile ball_before_camera_and_lamp() {
    return course_floor(32, 64, 20.0 * ball_camera,
                        concat(R"(
        "materials": {"floor": {"diffuse": 1}, "lamp": {"emission": [1, 0, 0]}, "sky": {"emission": [0, 1, 0]},
                      "ball": {"emission": [0, 0, 1]}},
        "spheres": [{"center": [0, 100, 0], "radius": )",
                               formatted("%.17g", 100.0 * std::sin(overhead_half_angle)), R"(, "material": "lamp"},
                    {"center": )",
                               numbers({ball_begin, 1.0, 0.0}), R"(, "radius": )", formatted("%.17g", ball_radius),
                               R"(, "motion": )", numbers({ball_motion, 0.0, 0.0}), R"(, "material": "ball"}],
        "planes": [{"normal": [0, 1, 0], "offset": 0, "material": "floor"},
                   {"normal": [0, -1, 0], "offset": 1000, "material": "sky"}])"));
}

SceneFile moving_ball_under_the_sky() {
    return course_floor(32, 16, {0.0, 2.0, 0.0}, R"(
        "materials": {"ball": {"diffuse": 1}, "sky": {"emission": 1}},
        "spheres": [{"center": [0, 0, 0], "radius": 1000, "material": "sky"},
                    {"center": [-0.6, 0, 0], "radius": 1, "motion": [1.2, 0, 0], "material": "ball"}])");
}

FloorLight light_below_the_ball() {
    constexpr int count = 1 << 12;
    const auto hides = [](double time, const glm::dvec3 &direction) {
        const glm::dvec3 ball(ball_begin + time * ball_motion, 1.0, 0.0);
        const double along = glm::dot(ball, direction);
        return along > 0.0 && glm::dot(ball, ball) - along * along < ball_radius * ball_radius;
    };
    const auto light_at = [&](double time) {
        Channels light{};
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 up(0.0, 1.0, 0.0);
            const glm::dvec3 direction = to_the_normals_side(lattice_direction(i, count), up);
            const double height = direction.y;
            const bool is_lamp = height > std::cos(overhead_half_angle);
            light.at(hides(time, direction) ? 2 : is_lamp ? 0 : 1) += 2.0 * height / count;
        }
        return light;
    };
    const auto mean_light = [&](double first) {
        constexpr int times = 64;
        Channels mean{};
        for (int i = 0; i < times; ++i) {
            const Channels light = light_at(first + (1.0 - first) * (i + 0.5) / times);
            for (std::size_t channel = 0; channel < light.size(); ++channel)
                mean.at(channel) += light.at(channel) / times;
        }
        return mean;
    };
    const double hidden = ((ball_camera.x + ball_radius) / ball_camera.y - ball_begin) / ball_motion;
    const auto seen = [&](const Channels &light) {
        return Channels{(1.0 - hidden) * light[0], (1.0 - hidden) * light[1], (1.0 - hidden) * light[2] + hidden};
    };
    return {seen(mean_light(hidden)), seen(light_at(0.0)), seen(mean_light(0.0))};
}

SceneFile disc(bool moves) {
    const glm::dvec2 motion = moves ? disc_motion : glm::dvec2(0.0);
    return parse_scene(
        formatted(R"({"film": {"width": 32, "height": 32}, "render": {"spp": 256, "max_path_length": 1, )"
                  R"("sampler": "random"}, "camera": {"projection": "orthographic", "position": [0, 0, 20], )"
                  R"("look_at": [0, 0, 0], "vertical_extent": 32}, )") +
            formatted(R"("materials": {"lamp": {"emission": [%g, %g, %g]}}, )", disc_emission[0], disc_emission[1],
                      disc_emission[2]) +
            formatted(R"("spheres": [{"center": [%g, %g, 0], "radius": %g, "motion": [%g, %g, 0], )", disc_center.x,
                      disc_center.y, disc_radius, motion.x, motion.y) +
            R"("material": "lamp"}]})",
        "");
}

double disc_cosine() {
    const glm::dvec2 from_center = glm::dvec2(0.5, -0.5) - disc_center;
    return std::sqrt(1.0 - glm::dot(from_center, from_center) / (disc_radius * disc_radius));
}

std::vector<Measured> disc_values(std::span<const double> coverage, double bound_factor) {
    double sum = 0.0;
    glm::dvec2 first{};
    for (std::size_t i = 0; i < coverage.size(); ++i) {
        const glm::dvec2 place(static_cast<double>(i % disc_side) + 0.5,
                               disc_side - 0.5 - static_cast<double>(i / disc_side));
        sum += coverage[i];
        first += coverage[i] * place;
    }
    const glm::dvec2 middle = first / sum;
    double soft = 0.0;
    double slanted = 0.0;
    double spread = 0.0;
    for (std::size_t i = 0; i < coverage.size(); ++i) {
        const glm::dvec2 place(static_cast<double>(i % disc_side) + 0.5,
                               disc_side - 0.5 - static_cast<double>(i / disc_side));
        const glm::dvec2 offset = place - middle;
        const double partial = coverage[i] * (1.0 - coverage[i]);
        soft += partial;
        slanted += offset.x * offset.y > 0.0 ? partial : -partial;
        spread += coverage[i] * offset.x * offset.x / sum;
    }
    constexpr double half = 0.5 * disc_side;
    return {{"the disc's middle, to the right", middle.x - half, 0.05 * bound_factor},
            {"the disc's middle, up", middle.y - half, 0.05 * bound_factor},
            {"softness of its edge", soft, 1.0 * bound_factor},
            {"slant of its edge", slanted, 1.0 * bound_factor},
            {"its spread along x", spread, 0.3 * bound_factor}};
}

// A pixel's mean of 256 samples has a standard deviation of at most 1/32. About 80 pixels are partly covered. The
// values `soft` and `slanted` therefore have a standard deviation below sqrt(80) / 32 = 0.28. Their bound is 1.
std::vector<Measured> disc_values(const Picture &picture) {
    std::vector<double> coverage;
    for (std::uint32_t y = 0; y < picture.height; ++y)
        for (std::uint32_t x = 0; x < picture.width; ++x)
            coverage.push_back(picture.at(x, y, 0) / disc_emission[0]);
    return disc_values(coverage, 1.0);
}

std::vector<Range> disc_values(bool moves, const std::vector<DiscSample> &samples) {
    std::vector<double> coverage;
    for (std::uint32_t y = 0; y < disc_side; ++y) {
        for (std::uint32_t x = 0; x < disc_side; ++x) {
            const auto covers = [&](const DiscSample &sample) {
                const glm::dvec2 place(x + sample.place.x - 0.5 * disc_side, 0.5 * disc_side - y - sample.place.y);
                const glm::dvec2 center = disc_center + (moves ? sample.time : 0.0) * disc_motion;
                return glm::length(place - center) < disc_radius;
            };
            coverage.push_back(static_cast<double>(std::ranges::count_if(samples, covers)) /
                               static_cast<double>(samples.size()));
        }
    }
    std::vector<Range> ranges;
    for (const Measured &measured : disc_values(coverage, 0.0))
        ranges.push_back(exactly(measured.value));
    return ranges;
}

SceneFile course_scene(const std::string &name, std::uint32_t sample_count, std::uint32_t max_path_length,
                       std::uint32_t estimator) {
    SceneFile scene = parse_scene(course_file("scenes/" + name), name);
    scene.render.width = 64;
    scene.render.height = 32;
    scene.render.max_path_length = max_path_length;
    scene.render.estimator = estimator;
    scene.sample_count = sample_count;
    return scene;
}

} // namespace cli
