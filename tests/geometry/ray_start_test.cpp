#include "lib/scene/checked_scene.h"
#include "lib/view/prepared_scene.h"
#include "lib/view/projection.h"
#include "lib/view/seen_scene.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

const glm::dvec3 camera_position = {1, 2, 3};

pt::Camera looking_along(const glm::dvec3 &forward, double vertical_fov) {
    const glm::dvec3 ahead = glm::normalize(forward);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
    return {camera_position, right, glm::cross(right, ahead), ahead, std::tan(0.5 * vertical_fov), 0.0, 1.0};
}

pt::Camera parallel_along(const glm::dvec3 &forward, double extent) {
    pt::Camera camera = looking_along(forward, 0.0);
    camera.view_size = extent;
    camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    return camera;
}

const glm::dvec3 oblique = glm::normalize(glm::dvec3(0.48, 0.6, -0.64));

double start_of(const std::vector<pt::Sphere> &spheres, const std::vector<pt::Plane> &planes,
                const pt::Camera &camera) {
    pt::Scene scene;
    scene.materials = {{glm::vec3(0.5F), glm::vec3(0), glm::vec3(0), 0}};
    scene.spheres = spheres;
    scene.planes = planes;
    const pt::Camera ahead = pt::projection_of(camera, 64, 64)->starting_ahead(scene, nullptr);
    EXPECT_LT(glm::length(ahead.position - camera.position - ahead.start_distance * camera.forward),
              1e-15 * ahead.start_distance + 1e-15);
    return ahead.start_distance;
}

pt::Sphere ball_from_camera(const glm::dvec3 &place, double radius, const glm::dvec3 &motion = {0, 0, 0}) {
    return {camera_position + place, radius, motion, 0};
}

// The limit is a view whose pixels have a side of 2^-14 of their distance: fov = 64 * 2^-14.
TEST(RayStart, IsThePinholeInWideViews) {
    EXPECT_EQ(start_of({ball_from_camera(1e6 * oblique, 1)}, {}, looking_along(oblique, 4.0e-3)), 0.0);
    EXPECT_GT(start_of({ball_from_camera(1e6 * oblique, 1)}, {}, looking_along(oblique, 3.8e-3)), 0.9e6);
}

constexpr double narrow = 1e-5;

// Rays start before the surface by half the view's diagonal there, 7.07e-6 of its distance.
TEST(RayStart, IsJustBeforeTheFirstSurfaceInView) {
    const pt::Camera camera = looking_along(oblique, narrow);
    const double width = std::tan(0.5 * narrow) * std::sqrt(2.0);
    EXPECT_EQ(start_of({}, {}, camera), 0.0);
    EXPECT_NEAR(start_of({ball_from_camera(1e6 * oblique, 2)}, {}, camera), (1e6 - 2) * (1 - width), 1e-3);
    EXPECT_NEAR(start_of({ball_from_camera(1e6 * oblique, 2), ball_from_camera(1e5 * oblique, 0.1)}, {}, camera),
                (1e5 - 0.1) * (1 - width), 1e-4);
    EXPECT_NEAR(start_of({}, {{{0, 1, 0}, -1e6 - 2, 0}}, camera), 1e6 / 0.6 * (1 - width), 20) << "a ceiling";
}

TEST(RayStart, LooksPastWhatIsOutOfView) {
    const pt::Camera camera = looking_along(oblique, narrow);
    const double alone = start_of({ball_from_camera(1e6 * oblique, 2)}, {}, camera);
    const glm::dvec3 aside = camera.right * (2.0 + 1e3 * narrow);
    EXPECT_EQ(start_of({ball_from_camera(1e6 * oblique, 2), ball_from_camera(-5.0 * oblique, 2)}, {}, camera), alone)
        << "behind";
    EXPECT_EQ(start_of({ball_from_camera(1e6 * oblique, 2), ball_from_camera(1e3 * oblique + aside, 2)}, {}, camera),
              alone)
        << "aside";
    EXPECT_EQ(start_of({ball_from_camera(1e6 * oblique, 2)}, {{{0, 1, 0}, -1, 0}}, camera), alone)
        << "a floor below the camera";
}

TEST(RayStart, IsInsideOfWhatHoldsTheCamera) {
    const pt::Camera camera = looking_along(oblique, narrow);
    EXPECT_NEAR(start_of({ball_from_camera({0, 0, 0}, 1e6)}, {}, camera), 1e6, 20);
    EXPECT_NEAR(start_of({ball_from_camera(-1e5 * oblique, 1e6)}, {}, camera), 9e5, 20);
    EXPECT_EQ(start_of({ball_from_camera({0, 0, 0}, 1e6, {1, 0, 0})}, {}, camera), 0.0) << "no matter how it moves";
    EXPECT_EQ(start_of({}, {{{0, 1, 0}, -2, 0}}, camera), 0.0) << "the camera is on the plane";
}

// Five eighths of the diagonal are 1.25 times its half, or 1.25 sqrt(2) for side 2.
TEST(RayStart, OfParallelRaysIsFiveEighthsOfTheDiagonalBeforeTheFirstSurface) {
    const pt::Camera camera = parallel_along(oblique, 2.0);
    const double before = 1.25 * std::sqrt(2.0);
    const glm::dvec3 place = camera_position + 1e4 * camera.forward;
    EXPECT_NEAR(start_of({{place, 3, {0, 0, 0}, 0}}, {}, camera), 1e4 - 3 - before, 1e-9);
    EXPECT_NEAR(start_of({}, {{camera.forward, -glm::dot(camera.forward, place), 0}}, camera), 1e4 - before, 1e-9);
    const pt::Sphere across{place, 3, 1000.0 * camera.right, 0};
    EXPECT_NEAR(start_of({across}, {}, camera), 1e4 - 3 - before, 1e-9) << "it comes no nearer on its way";
    const pt::Sphere towards{place, 3, -100.0 * camera.forward, 0};
    EXPECT_NEAR(start_of({towards}, {}, camera), 1e4 - 103 - before, 1e-9);
}

TEST(RayStart, OfParallelRaysIsOnOneSideOfALongCapsuleAcrossTheView) {
    pt::Camera camera = parallel_along(oblique, 2.0);
    pt::Sphere capsule{camera_position - 500.0 * camera.right, 0.25, 1000.0 * camera.right, 0, pt::Kind::capsule};
    camera.start_radius = std::sqrt(2.0);
    for (const double before : {1.25 * camera.start_radius, 0.9 * camera.start_radius, 0.0}) {
        capsule.center = camera_position - 500.0 * camera.right + (0.25 + before) * camera.forward;
        EXPECT_EQ(pt::divides_start(pt::seen_ball(capsule.ball(), camera), camera), before < camera.start_radius)
            << before;
    }
}

TEST(RayStart, OfParallelRaysIsAtThePositionWhereNothingIsInView) {
    const pt::Camera camera = parallel_along({0, 0, -1}, 2.0);
    EXPECT_EQ(start_of({{camera_position + glm::dvec3(0, 4, -50), 2, {0, 0, 0}, 0}}, {}, camera), 0.0) << "beside it";
    EXPECT_EQ(start_of({{camera_position + glm::dvec3(0, 0, 50), 2, {0, 0, 0}, 0}}, {}, camera), 0.0) << "behind";
    EXPECT_EQ(start_of({}, {{{0, 1, 0}, -1.5, 0}}, camera), 0.0) << "a plane divides the view";
}

TEST(RayStart, NothingInViewIsBeforeIt) {
    std::mt19937 engine(5);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(engine); };
    const auto direction = [&] { return glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)); };
    const auto in_view = [&] { return uniform(0, 1) < 0.5 ? uniform(-1, 1) : std::copysign(1.0, uniform(-1, 1)); };
    int near_misses[2] = {0, 0};
    for (int round = 0; round < 600; ++round) {
        const bool is_parallel = round % 3 == 0;
        const double fov = std::pow(10.0, uniform(-8, -2.5));
        const double extent = is_parallel ? std::pow(10.0, uniform(-2, 4)) : 0.0;
        const glm::dvec3 forward(uniform(-1, 1), uniform(-1, 1), -1.5);
        pt::Camera camera = is_parallel ? parallel_along(forward, extent) : looking_along(forward, fov);
        const double distance = is_parallel ? extent * std::pow(10.0, uniform(-1, 3)) : std::pow(10.0, uniform(0, 8));
        if (round % 3 == 1) {
            camera.focus = distance * std::pow(10.0, uniform(-1, 1));
            camera.lens_radius = camera.focus * std::pow(10.0, uniform(-5, -1));
        }
        const double spread = is_parallel ? extent : fov * distance;
        const glm::dvec3 place =
            camera.forward * distance + camera.right * uniform(-spread, spread) + camera.up * uniform(-spread, spread);
        const double radius = std::pow(10.0, uniform(-2, 2)) * spread;
        const glm::dvec3 way = round % 4 == 1 ? radius * direction() : glm::dvec3(0);
        const glm::dvec3 normal = glm::normalize(direction());
        const bool is_plane = round % 4 == 0;
        const double start = is_plane ? start_of({}, {{normal, -glm::dot(normal, camera_position + place), 0}}, camera)
                                      : start_of({ball_from_camera(place, radius, way)}, {}, camera);
        for (int i = 0; i < 100; ++i) {
            const double x = in_view();
            const double y = in_view();
            const glm::dvec3 through = camera.forward + camera.view_size * (x * camera.right + y * camera.up);
            glm::dvec3 from = 0.5 * extent * (x * camera.right + y * camera.up);
            glm::dvec3 ray = is_parallel ? camera.forward : glm::normalize(through);
            if (camera.has_lens()) {
                const double angle = uniform(-4, 4);
                from =
                    camera.lens_radius * uniform(0, 1) * (std::cos(angle) * camera.right + std::sin(angle) * camera.up);
                ray = glm::normalize(camera.focus * through - from);
            }
            const glm::dvec3 to = place + uniform(0, 1) * way - from;
            double t = std::numeric_limits<double>::infinity();
            if (is_plane) {
                const double met = glm::dot(normal, to) / glm::dot(normal, ray);
                t = met > 0 ? met : t;
            } else {
                const double b = glm::dot(to, ray);
                const double chord = radius * radius - glm::dot(to - b * ray, to - b * ray);
                const bool inside = glm::length(to) < radius;
                if (chord > 0 && (inside || b > 0))
                    t = inside ? b + std::sqrt(chord) : b - std::sqrt(chord);
            }
            const double depth = t * glm::dot(ray, camera.forward);
            EXPECT_GE(depth, start) << "round " << round;
            near_misses[is_parallel ? 0 : 1] += depth < 1.1 * start + 1.5 * extent && start > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(near_misses[0], 500) << "the bound is of use";
    EXPECT_GT(near_misses[1], 1000) << "the bound is of use";
}

// Float32 may place points within this margin on either side of a surface. The tree's start is therefore compared with
// lists of larger spheres. Spheres around the camera are smaller in the lists.
TEST(RayStart, OfATreeIsThatOfItsSpheres) {
    std::mt19937 engine(7);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(engine); };
    const pt_material grey{{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {0, 0, 0}, 0, 0};
    int ahead = 0;
    for (int round = 0; round < 300; ++round) {
        pt::Camera camera = looking_along({uniform(-1, 1), uniform(-1, 1), -1.5}, std::pow(10.0, uniform(-6, -2.5)));
        camera.projection = round % 2 == 0 ? PT_PROJECTION_PERSPECTIVE : PT_PROJECTION_ORTHOGRAPHIC;
        if (round % 2 != 0)
            camera.view_size = std::pow(10.0, uniform(-4, 1));
        const bool moves = round % 3 == 0;
        const glm::dvec3 middle = camera_position + (round % 5 == 0 ? 300.0 : 0.0) * camera.forward;
        const auto point = [&](double reach) {
            return glm::dvec3(uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach));
        };
        std::vector<pt::Sphere> list;
        std::vector<pt_sphere> held;
        const auto count = static_cast<int>(std::pow(10.0, uniform(0, 2.5)));
        for (int i = 0; i < count; ++i) {
            const bool is_sky = i == 3 && round % 4 == 0;
            const glm::dvec3 center = is_sky ? camera_position : middle + point(10);
            const glm::dvec3 way = moves && !is_sky ? point(0.5) : glm::dvec3(0);
            const double radius = is_sky ? 30 : uniform(0.1, 1.5);
            held.push_back({{center.x, center.y, center.z}, radius, {way.x, way.y, way.z}, 0, 0});
            const bool is_around = way == glm::dvec3(0) && glm::length(center - camera_position) < radius;
            list.push_back({center, radius * (is_around ? 1.0 - 0x1p-15 : 1.0 + 0x1p-15), way, 0});
        }
        const pt::PreparedScene prepared = prepared_scene_of(checked_scene_of(scene_of({&grey, 1}, held, {})), 1);
        const double start =
            pt::projection_of(camera, 64, 64)->starting_ahead(prepared.scene, prepared.tree.get()).start_distance;
        const double expected = start_of(list, {}, camera);
        EXPECT_NEAR(start, expected, 1e-3 * (1.0 + 1e-3 * expected)) << "round " << round;
        ahead += expected > 1.0 ? 1 : 0;
    }
    EXPECT_GT(ahead, 90) << "some start ahead";
}

} // namespace
