#include "phong_items.spv.h"
#include "shaders/specialization.h"
#include "tests/accuracy/direction.h"
#include "tests/accuracy/evaluation.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>

namespace accuracy::phong {

namespace {

struct Item {
    glm::vec3 axis;
    float glossiness;
    glm::vec3 outgoing;
    float diffuse;
    glm::vec3 normal;
    float specular;
    glm::vec2 numbers;
    float probability, unused;
};

struct Result {
    glm::vec4 direction;
    float power, value, density, unused;
};

glm::vec3 mirrored(const glm::vec3 &incoming, const glm::vec3 &normal) {
    const glm::dvec3 n = glm::normalize(glm::dvec3(normal));
    return {glm::normalize(glm::reflect(glm::dvec3(incoming), n))};
}

glm::vec3 beside(Inputs &inputs, const glm::vec3 &direction, double angle) {
    const glm::dvec3 axis(direction);
    const glm::dvec3 across = glm::normalize(glm::cross(axis, glm::dvec3(inputs.direction()) + glm::dvec3(0, 0, 0.01)));
    return {glm::normalize(std::cos(angle) * axis + std::sin(angle) * across)};
}

std::vector<Item> items(bool about_mirror) {
    Inputs inputs(about_mirror ? 2 : 3);
    std::vector<Item> items;
    for (std::size_t i = 0; i < random_count; ++i) {
        Item item{};
        item.axis = inputs.direction();
        item.normal = inputs.direction();
        if (glm::dot(item.normal, item.axis) > 0.0F)
            item.normal = -item.normal; // turned towards the path's origin
        const float exponents[] = {0.0F, 1.0F, 1e9F, static_cast<float>(inputs.log_uniform(1e-3, 1e9))};
        item.glossiness = exponents[std::min<std::size_t>(i % 16, 3)];
        const double width = std::min(1.0, std::sqrt(2.0 / std::max(item.glossiness, 1.0F)));
        const double angle = i % 3 == 0 ? inputs.number() * 3.14 : width * inputs.log_uniform(1e-4, 12.0);
        item.outgoing = beside(inputs, about_mirror ? mirrored(item.axis, item.normal) : item.axis, angle);
        item.diffuse = inputs.number();
        item.specular = inputs.number();
        item.numbers = {inputs.number(), inputs.number()};
        item.probability = inputs.number();
        items.push_back(item);
    }
    return items;
}

Probe phong_probe() {
    std::vector<std::uint32_t> constants(pt::gpu::CONSTANT_COUNT);
    constants[pt::gpu::ID_SPHERE_COUNT] = 1;
    constants[pt::gpu::ID_MAX_PATH_LENGTH] = 2;
    constants[pt::gpu::ID_ESTIMATOR] = PT_ESTIMATOR_MIS;
    constants[pt::gpu::ID_GLOSS] = 1;
    return {phong_items_spirv(), sizeof(ItemRange), constants};
}

struct Bounded {
    Real exact;
    Real bound;
};

Real power(Real cosine, Real n) {
    return cosine > 0 ? std::pow(cosine, n) : 0;
}

// The lobe is max(0, wo . r)^n. mirror_error is the error of r. Let u = 2^-24 and y = |wo - r|^2 / 2. Differences add
// errors of 2 u, squares add u, and sums add 2 u. If the lengths are 1 + a and 1 + b, y becomes y (1 + a) (1 + b) + (a
// - b)^2 / 2. The relative error of log2(1 - y) is largest at y = 1/4, where the value is 0.415 and an ulp is u / 2: 18
// ulp = 9 u < 22 u * 0.415. The product with n adds u, and 2^x adds 3 + 2 |x| ulp, where an ulp is at most 2 u. Below
// 2^-99 the lobe is 0.
Bounded lobe(const Direction &r, const Direction &wo, Real r_length, Real wo_length, Real mirror_error, Real n) {
    const Direction chord = wo - r;
    const Real y = glm::dot(chord, chord) / 2;
    const Real length = std::sqrt(2 * y);
    const Real y_bound = y * (5 * half_ulp + r_length + wo_length) +
                         (r_length + wo_length) * (r_length + wo_length) / 2 + length * mirror_error +
                         mirror_error * mirror_error;
    const Real exact = y < 1 ? std::exp(n * std::log1p(-y)) : 0;
    const Real spread = std::max(power(1 - y + y_bound, n) - exact, exact - power(1 - y - y_bound, n));
    const Real exponent = y < 1 ? -n * std::log1p(-y) : 0;
    return {exact, spread + exact * (29 * exponent + 6) * half_ulp + 0x1p-99L};
}

Bounded lobe_about_axis(const Item &item) {
    return lobe(glm::normalize(Direction(item.axis)), glm::normalize(Direction(item.outgoing)), length_error(item.axis),
                length_error(item.outgoing), 0, item.glossiness);
}

// Errors in I - 2 (N . I) N, with u = half_ulp: 2 u in the dot product, 4 u + 2 u in the second term, u in the
// difference. Four
// times the deviation of the normal's length from 1 is added.
Bounded lobe_about_mirror(const Item &item) {
    const Direction normal = glm::normalize(Direction(item.normal));
    const Direction r = glm::reflect(glm::normalize(Direction(item.axis)), normal);
    return lobe(r, glm::normalize(Direction(item.outgoing)), length_error(item.axis), length_error(item.outgoing),
                7 * half_ulp + 4 * length_error(item.normal), item.glossiness);
}

// The coefficients of value / cosine, or of the density (pt.h; Lafortune and Willems 1994).
struct Terms {
    Real diffuse, specular;

    Real peak() const { return std::max<Real>(diffuse + specular, 0x1p-60L); }
};

Terms value_terms(const Item &item) {
    return {item.diffuse / pi, item.specular * (Real{item.glossiness} + 2) / (2 * pi)};
}

Terms density_terms(const Item &item) {
    const Real p = item.probability;
    return {(1 - p) / pi, p * (Real{item.glossiness} + 1) / (2 * pi)};
}

// The dot product has an error of 2 u. The deviations of both lengths from 1 are added.
Bounded cosine_of(const Item &item) {
    const Direction normal = glm::normalize(Direction(item.normal));
    return {std::max<Real>(glm::dot(normal, glm::normalize(Direction(item.outgoing))), 0),
            2 * half_ulp + length_error(item.normal) + length_error(item.outgoing)};
}

// The specular term has an error of u each for n + 2, for the factor and for the lobe, and of 5.5 u for the division by
// 2 pi. Adding the diffuse term and multiplying by the cosine add u each.
constexpr Real rounding = 11 * half_ulp;

Bounded value_of(const Item &item) {
    const auto [diffuse, specular] = value_terms(item);
    const Bounded power = lobe_about_mirror(item);
    const Bounded cosine = cosine_of(item);
    const Real f = diffuse + specular * power.exact;
    return {f * cosine.exact, specular * power.bound * (cosine.exact + cosine.bound) +
                                  f * (cosine.bound + rounding * cosine.exact) + 0x1p-120L};
}

Bounded density_of(const Item &item) {
    const auto [diffuse, specular] = density_terms(item);
    const Bounded power = lobe_about_mirror(item);
    const Bounded cosine = cosine_of(item);
    const Real exact = diffuse * cosine.exact + specular * power.exact;
    return {exact, diffuse * cosine.bound + specular * power.bound + rounding * exact};
}

TEST(AccuracyPhong, OfLobes) {
    Comparison power("lobe_power", "absolute");
    Comparison direction("lobe_cos_sin", "length");
    const std::vector<Item> all = items(false);
    Probe probe = phong_probe();
    const std::vector<Result> results = evaluate<Result>(probe, all);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Item &item = all[i];
        const Bounded lobe = lobe_about_axis(item);
        power.add(results[i].power, lobe.exact, lobe.bound, list(item.axis, item.glossiness, item.outgoing));
        // Let t be the random number. In 1 - 2^(log2(1 - t) / (n + 1)), the logarithm has an error of 22 u, n + 1 of u,
        // and the division of 5 u. These are relative errors of x = ln(1 - t) / (n + 1), and are multiplied by |x| e^x
        // / (1 - e^x) <= 1. 2^x adds 2.5 ulp <= 5 u.
        const Real h = -std::expm1(std::log1p(-Real{item.numbers.x}) / (Real{item.glossiness} + 1));
        direction.add(glm::vec3(results[i].direction),
                      turned_to(item.axis, direction_at(1 - h, std::sqrt(h * (2 - h)), item.numbers.y)),
                      direction_about_bound(item.axis, h, 35 * half_ulp),
                      list(item.axis, item.glossiness, item.numbers));
    }
    power.finish();
    direction.finish();
}

TEST(AccuracyPhong, OfReflection) {
    Comparison value("reflection.value", "of its peak");
    Comparison density("reflection.density", "of its peak");
    const std::vector<Item> all = items(true);
    Probe probe = phong_probe();
    const std::vector<Result> results = evaluate<Result>(probe, all);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Bounded exact_value = value_of(all[i]);
        const Real value_peak = value_terms(all[i]).peak();
        value.add(results[i].value / value_peak, exact_value.exact / value_peak, exact_value.bound / value_peak,
                  list(all[i]));
        const Bounded exact_density = density_of(all[i]);
        const Real density_peak = density_terms(all[i]).peak();
        density.add(results[i].density / density_peak, exact_density.exact / density_peak,
                    exact_density.bound / density_peak, list(all[i]));
    }
    value.finish();
    density.finish();
}

} // namespace

} // namespace accuracy::phong
