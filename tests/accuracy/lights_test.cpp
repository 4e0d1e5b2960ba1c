#include "lamp_items.spv.h"
#include "shaders/specialization.h"
#include "tests/accuracy/direction.h"
#include "tests/accuracy/evaluation.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>

namespace accuracy::lights {

namespace {

constexpr std::uint32_t lamp_count = 512;

struct Lamp {
    glm::vec3 center;
    float radius;
    float radiance;
};

struct Item {
    glm::vec3 position;
    std::uint32_t lamp;
    glm::vec4 normal;
    glm::vec4 numbers;
};

struct Result {
    glm::vec3 direction;
    float distance;
    float height, density, weight, unused;
};

std::vector<Lamp> lamps() {
    Inputs inputs(6);
    std::vector<Lamp> lamps;
    for (std::uint32_t i = 0; i < lamp_count; ++i) {
        const auto distance = static_cast<float>(inputs.log_uniform(1e-2, 1e3));
        lamps.push_back({distance * inputs.direction(), static_cast<float>(inputs.log_uniform(1e-3, 1e3)),
                         static_cast<float>(inputs.log_uniform(1e-6, 1e6))});
    }
    return lamps;
}

std::vector<Item> items(const std::vector<Lamp> &lamps) {
    Inputs inputs(7);
    std::vector<Item> items;
    for (std::uint32_t i = 0; i < random_count; ++i) {
        const Lamp &lamp = lamps[i % lamp_count];
        const double sine = i % 3 == 0 ? 1.0 - inputs.log_uniform(1e-6, 0.5) : inputs.log_uniform(1e-7, 1.0);
        const glm::dvec3 axis(inputs.direction());
        glm::dvec3 normal(inputs.direction());
        if (i % 4 == 0) {
            const glm::dvec3 across = glm::cross(axis, normal + glm::dvec3(0.0, 0.01, 0.02));
            const double cosine = -sine * (1.0 + (inputs.number() - 0.5) * inputs.log_uniform(1e-8, 1.0));
            normal = cosine * axis + std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) * glm::normalize(across);
        }
        items.push_back({glm::vec3(glm::dvec3(lamp.center) - lamp.radius / sine * axis), i % lamp_count,
                         glm::vec4(glm::vec3(glm::normalize(normal)), 0.0F),
                         glm::vec4(inputs.number(), inputs.number(), 0.0F, 0.0F)});
    }
    return items;
}

Real root_bound(Real square, Real bound) {
    const Real root = std::sqrt(std::max<Real>(square, 0));
    return std::max(std::sqrt(std::max<Real>(square, 0) + bound) - root,
                    root - std::sqrt(std::max<Real>(square - bound, 0)));
}

struct View {
    Direction axis;
    Real distance;
    Real squared_sine;
    Real height;
    Real height_share;
    Real highest_cosine;

    View(const Lamp &lamp, const Item &item) {
        const Direction to_center = Direction(lamp.center) - Direction(item.position);
        distance = glm::length(to_center);
        axis = to_center / distance;
        squared_sine = Real{lamp.radius} * lamp.radius / (distance * distance);
        const Real cosine = std::sqrt(std::max<Real>(1 - squared_sine, 0));
        height = squared_sine / (1 + cosine);
        highest_cosine = glm::dot(glm::normalize(Direction(item.normal)), axis) + Real{lamp.radius} / distance;
        // sin^2 has errors of u for r^2, 5 u for d^2 and 5 u for the division. 1 - sin^2 has the same absolute error,
        // plus u / 2. Then sqrt adds 9 u, the sum adds u, and the division adds 5 u.
        const Real cosine_bound = root_bound(1 - squared_sine, 11.5L * half_ulp) + 9 * half_ulp * cosine;
        height_share = 16 * half_ulp + (cosine_bound + 2 * half_ulp) / (1 + cosine - cosine_bound);
    }
};

// The axis has an error of 8.5 u: u for the differences, 6.5 u for inversesqrt of d^2 and u for the product. This error
// counts once along the direction, and three times across, because the basis turns with the axis. direction_about()
// adds its own error, and u for the rounding of u.x h.
Real direction_bound(const View &view, const glm::vec3 &axis, Real h) {
    const Real axis_bound = 8.5L * half_ulp;
    const Real sine = std::sqrt(h * (2 - h));
    return direction_about_bound(axis, h, view.height_share + half_ulp) + axis_bound +
           std::sqrt(Real{2}) * sine * (3 + 2.5L) * axis_bound + axis_bound;
}

// d has an error of 7.5 u: 2.5 u for d^2, 4 u for inversesqrt and u for the product. r^2 - d^2 h (2 - h) has an error
// of 3 u r^2. The second term adds 18 u and the relative error of h.
Real distance_bound(const View &view, const Lamp &lamp, Real h) {
    const Real share = view.height_share + half_ulp;
    const Real squared_radius = Real{lamp.radius} * lamp.radius;
    const Real lost = view.distance * view.distance * h * (2 - h);
    const Real square = squared_radius - lost;
    const Real half_chord = root_bound(square, 3 * half_ulp * squared_radius + (18 * half_ulp + share) * lost);
    return half_chord + 9 * half_ulp * std::sqrt(std::max<Real>(square, 0)) +
           view.distance * (10 * half_ulp + share * h);
}

// The stated radiance sin^2 min(1, highest cosine) must not be 0 if the bound of the irradiance is not 0. The dot
// product and the sum add errors of 4 u, the factor 1 / d adds 7.5 u, and the length of the normal adds its deviation
// from 1.
TEST(AccuracyLights, OfLampSamples) {
    const std::vector<Lamp> all_lamps = lamps();
    const std::vector<Item> all = items(all_lamps);
    std::vector<std::uint32_t> constants(pt::gpu::CONSTANT_COUNT);
    constants[pt::gpu::ID_SPHERE_COUNT] = lamp_count;
    constants[pt::gpu::ID_LAMP_COUNT] = lamp_count;
    constants[pt::gpu::ID_SCENE_SOURCE] = pt::gpu::SCENE_IN_UNIFORM;
    std::vector<glm::vec4> scene;
    for (const Lamp &lamp : all_lamps)
        scene.emplace_back(lamp.center, lamp.radius);
    for (const Lamp &lamp : all_lamps)
        scene.emplace_back(lamp.radiance);
    Probe probe(lamp_items_spirv(), sizeof(ItemRange), constants);
    probe.set_scene(scene);
    const std::vector<Result> results = evaluate<Result>(probe, all);
    Comparison height("one_minus_cos", "of itself");
    Comparison density("cone_density", "of itself");
    Comparison direction("sample_lamp direction", "length");
    Comparison distance("sample_lamp distance", "of the lamp's");
    Comparison weight("lamp weight", "of radiance sin^2");
    std::size_t lost = 0;
    std::size_t dark = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Item &item = all[i];
        const Lamp &lamp = all_lamps[item.lamp];
        const Result &result = results[i];
        const View view(lamp, item);
        if (view.squared_sine > 1 - 12 * half_ulp)
            continue; // The vertex is on the lamp.
        const std::vector<float> input = list(item.position, lamp.center, lamp.radius, item.normal, item.numbers);
        height.add(result.height / view.height, 1, view.height_share, input);

        const Real cosine = std::min<Real>(view.highest_cosine, 1);
        const Real cosine_bound =
            12 * half_ulp * (1 + std::sqrt(view.squared_sine)) + length_error(glm::vec3(item.normal));
        const Real brightest = lamp.radiance * view.squared_sine;
        weight.add(result.weight / brightest, std::max<Real>(cosine, 0), cosine_bound + 13 * half_ulp, input);
        if (cosine < cosine_bound) {
            EXPECT_TRUE(cosine > -cosine_bound || result.weight == 0.0F) << "a lamp below the horizon, item " << i;
            dark += result.weight > 0.0F ? 0 : 1;
            continue;
        }
        lost += result.weight > 0.0F ? 0 : 1;
        // In 1 / (2 pi h), the constant has an error of u / 2. The product adds u, and the division adds 5 u.
        density.add(result.density * (2 * pi * view.height), 1, view.height_share * 1.01L + 7 * half_ulp, input);
        const Real h = item.numbers.x * view.height;
        direction.add(result.direction,
                      turned_to(glm::vec3(view.axis), direction_at(1 - h, std::sqrt(h * (2 - h)), item.numbers.y)),
                      direction_bound(view, glm::vec3(view.axis), h), input);
        const Real squared_sine = h * (2 - h);
        const Real half_chord =
            std::sqrt(Real{lamp.radius} * lamp.radius - view.distance * view.distance * squared_sine);
        distance.add(result.distance / view.distance, (1 - h) - half_chord / view.distance,
                     distance_bound(view, lamp, h) / view.distance, input);
    }
    EXPECT_GT(dark, 0U) << "weights of 0 were not tested";
    EXPECT_EQ(lost, 0U) << "lamps above the horizon that cannot be sampled";
    height.finish();
    density.finish();
    direction.finish();
    distance.finish();
    weight.finish();
}

} // namespace

} // namespace accuracy::lights
