// How much of all directions the smallest lamp covers, against the area of a cap of the unit sphere.
#include "lib/scene/lamp_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace {

constexpr pt::Camera camera{.position = {1.0, 2.0, 3.0},
                            .right = {1, 0, 0},
                            .up = {0, 1, 0},
                            .forward = {0, 0, -1},
                            .tan_half_fov = 1.0,
                            .shutter_open = 0.0,
                            .shutter_close = 0.0};
constexpr std::uint32_t dark = 0;
constexpr std::uint32_t lamp = 1;

pt::Scene scene_of(const std::vector<pt::Sphere> &spheres) {
    const pt::Material black{glm::vec3(0), glm::vec3(0), glm::vec3(0), 0.0F};
    const pt::Material bright{glm::vec3(0), glm::vec3(0), glm::vec3(0, 0, 5), 0.0F};
    return {{black, bright}, spheres, {}};
}

pt::Sphere sphere_at(double distance, double radius, std::uint32_t material) {
    return {camera.position + glm::dvec3(0, distance, 0), radius, glm::dvec3(0), material};
}

TEST(LampShare, IsThatOfTheCapWithinTheCone) {
    const double near = pt::smallest_lamp_share(scene_of({sphere_at(2, 1, lamp)}), camera).value();
    EXPECT_DOUBLE_EQ(near, 0.5 * (1.0 - std::sqrt(3.0) / 2.0));
    const double far = pt::smallest_lamp_share(scene_of({sphere_at(1e8, 1, lamp)}), camera).value();
    EXPECT_NEAR(far, 0.25e-16, 1e-30);
}

TEST(LampShare, IsThatOfTheSmallestLampThatMatters) {
    const double smallest = pt::smallest_lamp_share(scene_of({sphere_at(4, 1, lamp)}), camera).value();
    const std::vector<pt::Sphere> spheres{sphere_at(2, 1, lamp), sphere_at(9, 1, dark), sphere_at(4, 1, lamp),
                                          sphere_at(1, 50, lamp)};
    EXPECT_DOUBLE_EQ(pt::smallest_lamp_share(scene_of(spheres), camera).value(), smallest);
    // One that covers 1/400 as much gives less than a hundredth of the light.
    std::vector<pt::Sphere> with_a_speck = spheres;
    with_a_speck.push_back(sphere_at(80, 1, lamp));
    EXPECT_DOUBLE_EQ(pt::smallest_lamp_share(scene_of(with_a_speck), camera).value(), smallest);
}

// With a view of 90 degrees and 200 rows a lamp at the depth d has 100 r / d pixels as its radius.
TEST(LampShare, InPixelsIsThatOfLampsInView) {
    const auto pixels = [](const pt::Camera &seen_by, const glm::dvec3 &place) {
        const std::vector<pt::Sphere> spheres{{camera.position + place, 0.5, glm::dvec3(0), lamp}};
        return pt::pixels_of_smallest_lamp_in_view(scene_of(spheres), seen_by, 400, 200).value_or(0.0);
    };
    EXPECT_DOUBLE_EQ(pixels(camera, {19, 9, -10}), 25.0 * std::numbers::pi);
    EXPECT_EQ(pixels(camera, {19, 11, -10}), 0.0);
    EXPECT_EQ(pixels(camera, {21, 9, -10}), 0.0);
    EXPECT_EQ(pixels(camera, {1, 1, 10}), 0.0) << "behind";
    pt::Camera parallel = camera;
    parallel.vertical_extent = 20.0;
    EXPECT_DOUBLE_EQ(pixels(parallel, {19, 9, -1000}), 25.0 * std::numbers::pi);
    EXPECT_EQ(pixels(parallel, {19, 11, -1000}), 0.0);
}

TEST(LampShare, IsNothingWithoutLampsToMiss) {
    EXPECT_FALSE(pt::smallest_lamp_share(scene_of({}), camera));
    EXPECT_FALSE(pt::smallest_lamp_share(scene_of({sphere_at(9, 1, dark), sphere_at(1, 50, lamp)}), camera));
}

} // namespace
