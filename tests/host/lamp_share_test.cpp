// How much of all directions the smallest lamp covers, against the area of a cap of the unit sphere.
#include "lib/scene/lamp_share.h"
#include "tests/support/right_angle_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace {

constexpr const pt::Camera &camera = right_angle_camera;
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

std::optional<double> smallest_share(const pt::Scene &scene, const pt::Camera &seen_by) {
    return pt::smallest_lamp_share(scene.spheres, scene.materials, seen_by);
}

TEST(LampShare, IsThatOfTheCapWithinTheCone) {
    const double near = smallest_share(scene_of({sphere_at(2, 1, lamp)}), camera).value();
    EXPECT_DOUBLE_EQ(near, 0.5 * (1.0 - std::sqrt(3.0) / 2.0));
    const double far = smallest_share(scene_of({sphere_at(1e8, 1, lamp)}), camera).value();
    EXPECT_NEAR(far, 0.25e-16, 1e-30);
}

TEST(LampShare, IsThatOfTheSmallestLampThatMatters) {
    const double smallest = smallest_share(scene_of({sphere_at(4, 1, lamp)}), camera).value();
    const std::vector<pt::Sphere> spheres{sphere_at(2, 1, lamp), sphere_at(9, 1, dark), sphere_at(4, 1, lamp),
                                          sphere_at(1, 50, lamp)};
    EXPECT_DOUBLE_EQ(smallest_share(scene_of(spheres), camera).value(), smallest);
    // One that covers 1/400 as much gives less than a hundredth of the light.
    std::vector<pt::Sphere> with_a_speck = spheres;
    with_a_speck.push_back(sphere_at(80, 1, lamp));
    EXPECT_DOUBLE_EQ(smallest_share(scene_of(with_a_speck), camera).value(), smallest);
}

TEST(LampShare, IsNothingWithoutLampsToMiss) {
    EXPECT_FALSE(smallest_share(scene_of({}), camera));
    EXPECT_FALSE(smallest_share(scene_of({sphere_at(9, 1, dark), sphere_at(1, 50, lamp)}), camera));
}

} // namespace
