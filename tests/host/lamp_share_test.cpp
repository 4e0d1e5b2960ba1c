// How much of all directions the smallest lamp covers, against the area of a cap of the unit sphere.
#include "lib/scene/lamp_share.h"

#include <gtest/gtest.h>

#include <cmath>
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
    const double found = pt::smallest_lamp_share(scene_of({sphere_at(2, 1, lamp)}), camera);
    EXPECT_DOUBLE_EQ(found, 0.5 * (1.0 - std::sqrt(3.0) / 2.0));
    const double tiny = pt::smallest_lamp_share(scene_of({sphere_at(1e8, 1, lamp)}), camera);
    EXPECT_NEAR(tiny, 0.25e-16, 1e-30);
}

TEST(LampShare, IsThatOfTheSmallestLamp) {
    const double all = pt::smallest_lamp_share(
        scene_of({sphere_at(2, 1, lamp), sphere_at(9, 1, dark), sphere_at(4, 1, lamp), sphere_at(1, 50, lamp)}),
        camera);
    EXPECT_DOUBLE_EQ(all, pt::smallest_lamp_share(scene_of({sphere_at(4, 1, lamp)}), camera));
}

TEST(LampShare, IsOneWithoutLampsToMiss) {
    EXPECT_EQ(pt::smallest_lamp_share(scene_of({}), camera), 1.0);
    EXPECT_EQ(pt::smallest_lamp_share(scene_of({sphere_at(9, 1, dark), sphere_at(1, 50, lamp)}), camera), 1.0);
}

} // namespace
