#include "intersection.spv.h"
#include "lib/view/view.h"
#include "tests/kernel/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace {

using Exact = glm::vec<3, long double>;

constexpr double eps = 0x1p-24;
constexpr std::uint32_t nothing = 0xffffffffU;

struct Ray {
    glm::vec3 origin;
    float start; // 0: on no surface, 1: outside on the sphere, -1: inside
    glm::vec3 direction;
    float unused = 0.0F;
};

struct Met {
    glm::vec3 position;
    float distance;
    glm::vec3 normal;
    float unused;
    std::uint32_t surface, blocked, inside, unused_too;
};

struct Ball {
    glm::dvec3 center;
    double radius;
};

enum class Held { AsTheSceneNeeds, ByItsCenter };

// The kernel stores the center of a ball that moves. The rays' time is 0, so the motion has no effect.
std::vector<Met> follow(const Ball &ball, const std::vector<Ray> &rays, Held held = Held::AsTheSceneNeeds) {
    pt::Scene scene;
    scene.materials = {{{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {0, 0, 0}, 0}};
    scene.spheres = {{ball.center, ball.radius, {held == Held::ByItsCenter ? ball.radius : 0.0, 0, 0}, 0}};
    const pt::Camera camera{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.0, 1.0};
    const pt::PreparedScene prepared(scene);
    const pt::View view = pt::view_of(pt::seen_scene(scene, camera), prepared, camera,
                                      {4, 4, 2, 0, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_RANDOM, 0, 4});
    const auto count = static_cast<std::uint32_t>(rays.size());
    auto constants = pt::specialization_constants(view.features);
    constants[pt::gpu::ID_KNOWN_SIDES] = 0;
    Probe probe(intersection_spirv(), sizeof count, constants);
    probe.set_scene(view.words);
    std::vector<glm::vec4> input;
    for (const Ray &ray : rays) {
        input.emplace_back(ray.origin, ray.start);
        input.emplace_back(ray.direction, 0.0F);
    }
    return probe.run<Met>(input, rays.size(), count, count);
}

// A ray's origin x has the height (|x - c|^2 - R^2) / (2 R) above the sphere.
struct Reference {
    long double height, half_chord, to_middle;

    Reference(const Ball &ball, const Ray &ray) {
        const Exact from_center = Exact(ray.origin) - Exact(ball.center);
        const Exact direction = glm::normalize(Exact(ray.direction));
        const long double radius = ball.radius;
        to_middle = -glm::dot(from_center, direction);
        const Exact across = from_center + to_middle * direction;
        half_chord = std::sqrt(std::max(0.0L, radius * radius - glm::dot(across, across)));
        height = (glm::length(from_center) - radius) * (glm::length(from_center) + radius) / (2.0L * radius);
    }
    long double near_root(long double radius) const {
        return to_middle > 0 ? 2 * radius * height / (to_middle + half_chord) : to_middle - half_chord;
    }
    long double far_root(long double radius) const {
        return to_middle > 0 ? to_middle + half_chord : 2 * radius * height / (to_middle - half_chord);
    }
};

// Largest errors, divided by their bounds.
//
// Let y = x + o n. A ray's origin x has the height n . x + o + k / 2 |y|^2. Let S = |x| + |o| + |y| (1 + k |y|), and c
// be the cosine at the hit. Rounding n, o and k and ten operations give the height an error of 8 eps S, and the slope
// an error of 8 eps (1 + k |y|). The distance has the error (height's error + t * slope's error) / c. The root doubles
// both: 16 eps (S + t (1 + k |y|)) / c. The point's error is the height's error at the point. The normal's error is k
// times this error, plus rounding.
struct Worst {
    double distance = 0, position = 0, normal = 0;
    int missed = 0, compared = 0;
};

Worst compare(const Ball &ball, const std::vector<Ray> &rays, const std::vector<Met> &all) {
    Worst worst;
    const long double radius = ball.radius;
    const long double offset = std::abs(glm::length(Exact(ball.center)) - radius);
    const Exact nearest = Exact(ball.center) * (1.0L - radius / glm::length(Exact(ball.center)));
    const auto scale = [&](const Exact &x) {
        const long double y = glm::length(x - nearest);
        return glm::length(x) + offset + y * (1 + y / radius);
    };
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Reference reference(ball, rays[i]);
        const long double cosine = reference.half_chord / radius;
        if (cosine < 1e-3L) // The bound is not valid for grazing rays.
            continue;
        const bool outside = rays[i].start != 0.0F ? rays[i].start > 0.0F : reference.height > 0.0L;
        const long double t = rays[i].start < 0.0F ? 2 * reference.to_middle
                              : outside            ? reference.near_root(radius)
                                                   : reference.far_root(radius);
        const bool expected = rays[i].start < 0.0F || (rays[i].start == 0.0F && t > 0.0L);
        ++worst.compared;
        const bool met = all[i].surface != nothing;
        if (met != expected || (all[i].blocked != 0) != expected || (met && (all[i].inside != 0) == outside)) {
            ++worst.missed;
            continue;
        }
        if (!expected)
            continue;
        const Exact origin(rays[i].origin);
        const Exact hit = origin + t * glm::normalize(Exact(rays[i].direction));
        const long double steepness = 1 + glm::length(origin - nearest) / radius;
        const long double distance_bound = 16 * eps * (scale(origin) + t * steepness) / cosine;
        const long double surface_bound = 16 * eps * scale(hit);
        const Exact from_center = Exact(all[i].position) - Exact(ball.center);
        const Exact normal = glm::normalize(from_center) * (all[i].inside != 0 ? -1.0L : 1.0L);
        const auto raise = [](double &value, long double ratio) {
            value = std::max(value, std::isnan(ratio) ? HUGE_VAL : static_cast<double>(ratio));
        };
        raise(worst.distance, std::abs(all[i].distance - t) / distance_bound);
        raise(worst.position, std::abs(glm::length(from_center) - radius) / surface_bound);
        raise(worst.normal, glm::length(Exact(all[i].normal) - normal) / (8 * eps + surface_bound / radius));
    }
    return worst;
}

class RandomRays {
public:
    explicit RandomRays(std::uint32_t seed) : engine_(seed) {}

    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    glm::dvec3 direction() {
        std::normal_distribution<double> normal;
        return glm::normalize(glm::dvec3(normal(engine_), normal(engine_), normal(engine_)));
    }
    std::vector<Ray> around_camera(double reach, std::size_t count) {
        std::vector<Ray> rays(count);
        for (Ray &ray : rays) {
            ray.origin = glm::vec3(uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach));
            glm::dvec3 towards = direction();
            towards.y *= std::pow(10.0, uniform(-3, 0));
            ray.direction = glm::vec3(glm::normalize(towards));
            ray.start = 0.0F;
        }
        return rays;
    }

private:
    std::mt19937 engine_;
};

Ball under_the_camera(double radius, double height) {
    return {-(radius + height) * glm::normalize(glm::dvec3(0.1, 1.0, -0.2)), radius};
}

void expect_within_bounds(const Worst &worst) {
    EXPECT_EQ(worst.missed, 0);
    EXPECT_LT(worst.distance, 1.0);
    EXPECT_LT(worst.position, 1.0);
    EXPECT_LT(worst.normal, 1.0);
}

constexpr std::size_t ray_count = 20000;

// Negative control: a huge sphere held by its center.
TEST(Intersection, HugeSpheresAreMetWithinTheRoundingOfTheScene) {
    RandomRays random(1);
    const std::vector<Ray> rays = random.around_camera(10.0, ray_count);
    for (const double height : {1.5, -1.5})
        for (const double radius : {1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9}) {
            const Ball ball = under_the_camera(radius, height);
            const Worst worst = compare(ball, rays, follow(ball, rays));
            SCOPED_TRACE(testing::Message() << "radius " << radius << ", camera height " << height);
            EXPECT_GT(worst.compared, 15000);
            expect_within_bounds(worst);
        }
    const Ball ball = under_the_camera(1e7, 1.5);
    const Worst control = compare(ball, rays, follow(ball, rays, Held::ByItsCenter));
    EXPECT_GT(control.distance, 100.0);
    EXPECT_GT(control.position, 100.0);
}

TEST(Intersection, CurvedPlanesAreMetFromFarAway) {
    RandomRays random(2);
    const Ball ball = under_the_camera(1e3, 1.5);
    std::vector<Ray> rays(ray_count);
    for (Ray &ray : rays) {
        ray.start = 0.0F;
        ray.origin = glm::vec3(ball.center + random.uniform(1.0, 5.0) * ball.radius * random.direction());
        ray.direction =
            glm::vec3(glm::normalize(ball.center + 0.99 * ball.radius * random.direction() - glm::dvec3(ray.origin)));
    }
    const Worst worst = compare(ball, rays, follow(ball, rays));
    EXPECT_GT(worst.compared, 15000);
    expect_within_bounds(worst);
}

// Rays that start outside never hit the sphere again. Rays that start inside hit the far wall. The chord is t = 2 s /
// k, so the slope's error of 8 eps gives t an error of 16 eps R = 8 eps t / s.
TEST(Intersection, RaysThatLeaveAHugeSphereMeetItAgainFromInsideOnly) {
    for (const double radius : {1e3, 1e6, 1e9}) {
        RandomRays random(3);
        const Ball ball = under_the_camera(radius, -1.5);
        const std::vector<Ray> towards = random.around_camera(1.0, ray_count);
        const std::vector<Met> wall = follow(ball, towards);
        for (const float start : {1.0F, -1.0F}) {
            std::vector<Ray> rays;
            for (std::size_t i = 0; i < wall.size(); ++i) {
                if (wall[i].surface == nothing || glm::length(wall[i].position) > 100.0F)
                    continue;
                const glm::dvec3 out = random.direction();
                const glm::dvec3 normal(wall[i].normal);
                const bool inwards = glm::dot(out, normal) > 0.0;
                rays.push_back({wall[i].position, start, glm::vec3((start < 0.0F) == inwards ? out : -out)});
            }
            EXPECT_GT(rays.size(), 1000U);
            const Worst worst = compare(ball, rays, follow(ball, rays));
            SCOPED_TRACE(testing::Message() << "radius " << radius << ", start " << start);
            expect_within_bounds(worst);
        }
    }
}

// Negative control: every positive distance is a hit.
bool met_by_sign(const Ball &ball, const Ray &ray) {
    const glm::vec3 to_center = glm::vec3(ball.center) - ray.origin;
    const auto radius = static_cast<float>(ball.radius);
    const float b = glm::dot(to_center, ray.direction);
    const glm::vec3 across = to_center - b * ray.direction;
    const float squared_half_chord = radius * radius - glm::dot(across, across);
    const float half_chord = std::sqrt(std::max(squared_half_chord, 0.0F));
    if (glm::dot(to_center, to_center) > radius * radius)
        return squared_half_chord >= 0.0F && b - half_chord > 0.0F;
    return b + half_chord > 0.0F;
}

// Within 3 eps r of the surface, float32 cannot decide the side. A ray inwards then hits the sphere either at once or
// at its far side.
TEST(Intersection, NothingLeaksThroughASphereNearItsSurface) {
    RandomRays random(4);
    const Ball ball{{0, 0, 0}, 3.0};
    std::vector<Ray> rays(ray_count);
    for (Ray &ray : rays) {
        const double gap = std::pow(2.0, random.uniform(-2, 6)) * 0x1p-23 * (random.uniform(-1, 1) > 0 ? 1 : -1);
        ray.start = 0.0F;
        ray.origin = glm::vec3(ball.radius * (1 + gap) * random.direction());
        ray.direction = glm::vec3(random.direction());
    }
    const std::vector<Met> met = follow(ball, rays);
    int compared = 0;
    int wrong_by_sign = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Reference reference(ball, rays[i]);
        const long double cosine = reference.to_middle / ball.radius;
        const bool undecided = std::abs(reference.height) < 3 * eps * ball.radius;
        if (std::abs(cosine) < 0.05L || (undecided && cosine < 0.0L))
            continue;
        ++compared;
        const bool outside = reference.height > 0.0L;
        const bool expected = !outside || cosine > 0.0L;
        wrong_by_sign += met_by_sign(ball, rays[i]) != expected ? 1 : 0;
        ASSERT_EQ(met[i].surface != nothing, expected);
        ASSERT_EQ(met[i].blocked != 0, expected);
    }
    EXPECT_GT(compared, 15000);
    EXPECT_GT(wrong_by_sign, 50) << "the rays must be near enough to tell the rules apart";
}

} // namespace
