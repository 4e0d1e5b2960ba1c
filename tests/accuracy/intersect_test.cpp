#include "distance_items.spv.h"
#include "shaders/specialization.h"
#include "tests/accuracy/direction.h"
#include "tests/accuracy/evaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>

namespace accuracy::intersect {

namespace {

constexpr float anywhere = 0.0F;
constexpr float leaving_outside = 1.0F;
constexpr float leaving_inside = 2.0F;

struct Item {
    glm::vec3 center; // relative to the ray's start; for planes the normal
    float radius;     // for planes the start's height
    glm::vec3 direction;
    float start;
};

struct Result {
    float sphere, plane;
    float blocks_before, blocks_behind; // whether a shadow ray that ends before or behind the hit is blocked
};

constexpr float no_hit = 3.0e38F;

// `impact` is the ray's distance from the center, in radii.
Item passing_ray(Inputs &inputs, double distance, double radius, double impact, float start) {
    const glm::dvec3 direction(inputs.direction());
    const glm::dvec3 across =
        glm::normalize(glm::cross(direction, glm::dvec3(inputs.direction()) + glm::dvec3(0, 0.01, 0.02)));
    const double sine = std::min(impact * radius / distance, 1.0);
    const double side = inputs.word() % 4 == 0 ? -1.0 : 1.0;
    const glm::dvec3 center = distance * (side * std::sqrt(1.0 - sine * sine) * direction + sine * across);
    return {glm::vec3(center), static_cast<float>(radius), glm::vec3(direction), start};
}

std::vector<Item> items() {
    Inputs inputs(10);
    std::vector<Item> items;
    for (std::size_t i = 0; i < random_count; ++i) {
        const double radius = inputs.log_uniform(1e-3, 1e3);
        const double grazing = 1.0 + (inputs.number() < 0.5F ? -1.0 : 1.0) * inputs.log_uniform(1e-6, 0.5);
        const float start = i % 8 < 6 ? anywhere : i % 8 == 6 ? leaving_outside : leaving_inside;
        const double impact = i % 2 == 0 || start != anywhere ? inputs.number() : grazing;
        const double distance = start != anywhere ? radius
                                : i % 3 == 0      ? radius * inputs.number()
                                                  : radius * (1.0 + inputs.log_uniform(1e-6, 1e6));
        items.push_back(passing_ray(inputs, std::max(distance, 1e-6 * radius), radius, impact, start));
    }
    for (std::size_t i = 0; i < random_count / 16; ++i) {
        const double radius = inputs.log_uniform(1e-3, 1e3);
        items.push_back(passing_ray(inputs, radius * (1.0 - inputs.log_uniform(1e-9, 1e-5)), radius, 1.0, anywhere));
    }
    return items;
}

// `met` is 1 for a hit, 0 for a miss, and -1 if float32 cannot decide.
struct Exact {
    int met;
    Real distance;
    Real bound;
};

// Let u = 2^-24, d = |center|, b = center . direction and l = |center - b direction|. The error of b is 3 u d, plus d
// times the deviation of the direction's length from 1. Across the ray, center - b direction has an error of u |b| + u
// l. Along the ray, only the square of b's error counts. Further errors are 3 u for l^2, u for r^2, u for the
// difference and 9 u for sqrt.
Exact exact_sphere(const Item &item) {
    const Direction center(item.center);
    const Direction direction = glm::normalize(Direction(item.direction));
    const Real r = item.radius;
    const Real d = glm::length(center);
    const Real b = glm::dot(center, direction);
    const Real b_bound = d * (3 * half_ulp + length_error(item.direction));
    if (item.start == leaving_outside)
        return {0, no_hit, 1};
    if (item.start == leaving_inside)
        return {std::abs(b) > b_bound ? 1 : -1, 2 * std::abs(b), 2 * b_bound}; // The ray starts on the surface.
    const Real l = glm::length(center - b * direction);
    const Real along = 2 * b_bound;
    const Real l_bound = half_ulp * (std::abs(b) + l);
    const Real square = r * r - l * l;
    const Real square_bound = 2 * l * l_bound + l_bound * l_bound + along * along + half_ulp * (4 * l * l + 2 * r * r);
    const Real half_chord = std::sqrt(std::max<Real>(square, 0));
    const Real bound = b_bound + 9 * half_ulp * half_chord + std::sqrt(std::max<Real>(square, 0) + square_bound) -
                       std::sqrt(std::max<Real>(square - square_bound, 0)) + 2 * half_ulp * (std::abs(b) + half_chord);
    if (std::abs(d * d - r * r) < 5 * half_ulp * d * d)
        return {-1, 0, 0}; // The ray starts on the surface.
    const bool outside = d > r;
    const Real distance = outside ? b - half_chord : b + half_chord;
    if (outside && std::abs(square) <= square_bound)
        return {-1, 0, 0}; // The ray grazes the sphere.
    const bool met = (square > 0 || !outside) && distance > 0;
    return {std::abs(distance) <= bound ? -1 : static_cast<int>(met), distance, bound};
}

// In -h / (n . v), the dot product has an error of 2 u |n|, and the division adds 5 u.
Exact exact_plane(const Item &item) {
    const Direction normal(item.center);
    const Real rate = glm::dot(normal, Direction(item.direction));
    const Real rate_bound = 3 * half_ulp * glm::length(normal);
    if (item.start != anywhere)
        return {0, no_hit, 1};
    if (std::abs(rate) <= 2 * rate_bound)
        return {-1, 0, 0}; // The ray is parallel to the plane.
    const Real distance = -item.radius / rate;
    return {distance > 0, distance, std::abs(distance) * (rate_bound / (std::abs(rate) - rate_bound) + 5 * half_ulp)};
}

bool agrees(const Exact &exact, float found) {
    return exact.met < 0 || (found != no_hit) == (exact.met == 1);
}

void compare(Comparison &comparison, const Exact &exact, float found, Real unit, const Item &item) {
    if (exact.met == 1 && found != no_hit)
        comparison.add(found / unit, exact.distance / unit, exact.bound / unit, list(item));
}

// Negative control: a radius 1.001 times as large.
Exact exact_larger_sphere(Item item) {
    item.radius *= 1.001F;
    return exact_sphere(item);
}

bool starts_outside(const Item &item) {
    const Real d = glm::length(Direction(item.center));
    const Real r = item.radius;
    return item.start == leaving_outside || (item.start == anywhere && d * d - r * r > 5 * half_ulp * d * d);
}

struct Wrong {
    std::size_t undecided = 0;
    std::size_t found = 0;
    std::size_t of_control = 0;
    std::size_t shadows = 0;
};

// Shadow rays end a tenth before or behind the hit. Hits nearer than 1e-4 |center| are skipped, because this distance
// is only 100 times the error of float32.
bool blocks_rightly(const Exact &exact, const Result &found, const Item &item) {
    if (exact.met == 1 && exact.distance > 1e-4L * glm::length(Direction(item.center)))
        return found.blocks_before == 0.0F && found.blocks_behind == 1.0F;
    return exact.met != 0 || found.blocks_behind == 0.0F;
}

Wrong compare_all(const std::vector<Item> &all, std::uint32_t inside, const std::string &name) {
    Comparison sphere("sphere_distance" + name, "of the center");
    Comparison leaving("sphere_distance" + name + ", leaving", "of the radius");
    Comparison plane("plane_distance" + name, "of itself");
    std::vector<std::uint32_t> constants(pt::gpu::CONSTANT_COUNT);
    constants[pt::gpu::ID_INSIDE] = inside;
    constants[pt::gpu::ID_SPHERE_COUNT] = 1;
    Probe probe(distance_items_spirv(), sizeof(ItemRange), constants);
    const std::vector<Result> results = evaluate<Result>(probe, all);
    Wrong wrong;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Exact exact = exact_sphere(all[i]);
        wrong.undecided += exact.met < 0 ? 1 : 0;
        wrong.found += agrees(exact, results[i].sphere) ? 0 : 1;
        wrong.shadows += blocks_rightly(exact, results[i], all[i]) ? 0 : 1;
        EXPECT_FALSE(std::isnan(results[i].sphere)) << "item " << i;
        wrong.of_control += agrees(exact_larger_sphere(all[i]), results[i].sphere) ? 0 : 1;
        const Real distance = glm::length(Direction(all[i].center));
        compare(all[i].start == anywhere ? sphere : leaving, exact, results[i].sphere, distance, all[i]);
        const Exact on_plane = exact_plane(all[i]);
        wrong.found += agrees(on_plane, results[i].plane) ? 0 : 1;
        compare(plane, on_plane, results[i].plane, std::abs(on_plane.distance), all[i]);
    }
    sphere.finish();
    if (inside == 1) // A ray that leaves the sphere from its surface hits nothing.
        leaving.finish();
    plane.finish();
    return wrong;
}

TEST(AccuracyIntersect, OfDistances) {
    const std::vector<Item> all = items();
    const Wrong wrong = compare_all(all, 1, "");
    EXPECT_EQ(wrong.found, 0U);
    EXPECT_GT(wrong.of_control, 0U);
    EXPECT_LT(wrong.undecided, all.size() / 8);
}

TEST(AccuracyIntersect, OfDistancesWherePathsAreNeverInside) {
    std::vector<Item> outside;
    std::ranges::copy_if(items(), std::back_inserter(outside), starts_outside);
    EXPECT_GT(outside.size(), random_count / 2);
    const Wrong wrong = compare_all(outside, 0, ", never inside");
    EXPECT_EQ(wrong.found, 0U);
    EXPECT_EQ(wrong.shadows, 0U);
    EXPECT_GT(wrong.of_control, 0U);
    EXPECT_LT(wrong.undecided, outside.size() / 4); // Half of the rays graze.
}

} // namespace

} // namespace accuracy::intersect
