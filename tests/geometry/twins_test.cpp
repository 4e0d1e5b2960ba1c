#include "lib/view/twins.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace {

using pt::Plane;
using pt::Sphere;

constexpr std::uint32_t plain = 0;
constexpr std::uint32_t glowing = 1;

const glm::dvec3 viewpoint = {1, 2, 3};

pt::Camera camera() {
    return {viewpoint, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.0, 1.0};
}

pt::Scene scene_of(const std::vector<Sphere> &spheres, const std::vector<Plane> &planes) {
    pt::Scene scene;
    scene.materials = {{glm::vec3(0.5F), glm::vec3(0), glm::vec3(0), 0}, {glm::vec3(0), glm::vec3(0), glm::vec3(1), 0}};
    scene.spheres = spheres;
    scene.planes = planes;
    return scene;
}

pt::SeenScene without_twins(const pt::Scene &scene) {
    return pt::without_twins(pt::seen_scene(scene, camera()));
}

std::size_t distinct(const std::vector<Sphere> &spheres) {
    return without_twins(scene_of(spheres, {})).spheres.size();
}

Sphere ball(const glm::dvec3 &place, double radius, const glm::dvec3 &motion = {0, 0, 0}) {
    return {viewpoint + place, radius, motion, plain};
}

Plane plane(const glm::dvec3 &normal, double offset, std::uint32_t material) {
    const glm::dvec3 unit = glm::normalize(normal);
    return {unit, offset - glm::dot(unit, viewpoint), material};
}

TEST(Twins, AreSpheresThatDifferByAMillionthOfTheirSize) {
    for (const double size : {1e-9, 1.0, 1e9})
        for (const double shift : {1e-6, 1e-7, 1e-8, 1e-9}) {
            const Sphere first = ball({0, 0, -5 * size}, size);
            EXPECT_EQ(distinct({first, ball({shift * size, 0, -5 * size}, size)}), 1U) << size << ' ' << shift;
            EXPECT_EQ(distinct({first, ball({0, 0, -5 * size}, size * (1 - shift))}), 1U) << size << ' ' << shift;
            EXPECT_EQ(distinct({first, ball({0, 30 * shift * size, -5 * size}, size)}), shift == 1e-6 ? 2U : 1U);
        }
}

TEST(Twins, AreSpheresWhoseCentersFloat32HoldsAlike) {
    EXPECT_EQ(distinct({ball({0, 0, -1e3}, 1), ball({4e-4, 0, -1e3}, 1)}), 1U);
    EXPECT_EQ(distinct({ball({0, 0, -1e2}, 1), ball({4e-4, 0, -1e2}, 1)}), 2U);
    EXPECT_EQ(distinct({ball({0, 0, -1e12}, 1), ball({2, 0, -1e12}, 1)}), 2U);
    EXPECT_EQ(distinct({ball({0, 0, -1e12}, 1), ball({0.1, 0, -1e12}, 1)}), 1U);
    EXPECT_EQ(distinct({ball({0, 0, -1e3}, 1), ball({0, 0, -1e3}, 1.0004)}), 2U) << "a ball in a thin shell";
}

TEST(Twins, MoveTogether) {
    const Sphere moving = ball({0, 0, -5}, 1, {0, 2, 0});
    EXPECT_EQ(distinct({moving, ball({0, 0, -5}, 1)}), 2U);
    EXPECT_EQ(distinct({moving, ball({0, 0, -5}, 1, {0, 2 + 1e-7, 0})}), 1U);
}

TEST(Twins, OfHugeSpheresAreLikePlanes) {
    constexpr double radius = 1e9;
    const Sphere floor = ball({0, -1 - radius, 0}, radius);
    EXPECT_EQ(distinct({floor, ball({0.01, -1 - radius, 0}, radius)}), 1U) << "moved along itself";
    EXPECT_EQ(distinct({floor, ball({0, -1.01 - radius, 0}, radius)}), 2U) << "1e-11 of the radius, 1% of the height";
    EXPECT_EQ(distinct({floor, ball({0, -1 - 2 * radius, 0}, 2 * radius)}), 2U);
    EXPECT_EQ(distinct({floor, ball({0, -1 - radius, 0}, radius, {1, 0, 0})}), 2U);
}

TEST(Twins, OfPlanesTheFirstStands) {
    const auto stands = [](const Plane &second) {
        const std::vector<pt::CurvedPlane> planes =
            without_twins(scene_of({}, {plane({0.3, 1, 0.2}, 1.5, plain), second})).planes;
        EXPECT_EQ(planes.front().material, plain);
        return planes.size() == 1;
    };
    EXPECT_TRUE(stands(plane({-0.3, -1, -0.2}, -1.5, glowing))) << "the other way round";
    EXPECT_FALSE(stands(plane({-0.3, -1, -0.2}, 1.5, glowing))) << "behind the camera";
    EXPECT_TRUE(stands(plane({0.3, 1, 0.2}, 1.5 * (1 + 1e-6), glowing)));
    EXPECT_FALSE(stands(plane({0.3, 1, 0.2}, 1.5 * (1 + 1e-5), glowing)));
    EXPECT_TRUE(stands(plane({0.3, 1 + 1e-6, 0.2}, 1.5, glowing)));
    EXPECT_FALSE(stands(plane({0.3, 1 + 3e-5, 0.2}, 1.5, glowing)));
}

TEST(Twins, AreNoneOnALattice) {
    std::vector<Sphere> lattice;
    for (int i = 0; i < 32 * 32 * 32; ++i)
        lattice.push_back(ball({i % 32, i / 32 % 32, -10 - i / 1024}, 0.5));
    EXPECT_EQ(distinct(lattice), lattice.size());
}

TEST(ClosePlanes, DifferByLessThanA256th) {
    const auto close = [](const Plane &second) {
        return without_twins(scene_of({}, {plane({0.3, 1, 0.2}, 1.5, 0), second})).close_planes;
    };
    EXPECT_TRUE(close(plane({0.3, 1, 0.2}, 1.5 * 1.003, 0)));
    EXPECT_TRUE(close(plane({-0.3, -1, -0.2}, -1.5 * 1.003, 0)));
    EXPECT_FALSE(close(plane({0.3, 1, 0.2}, 1.5 * 1.005, 0)));
    EXPECT_TRUE(close(plane({0.3, 1.003, 0.2}, 1.5, 0)));
    EXPECT_FALSE(close(plane({0.3, 1, 0.21}, 1.5, 0)));
}

bool close_lamps(const glm::dvec3 &shift, double radius, std::uint32_t first, std::uint32_t second) {
    std::vector<Sphere> spheres = {ball({0, 3, -5}, 1), ball(glm::dvec3(0, 3, -5) + shift, radius),
                                   ball({5, 0, -5}, 1)};
    spheres[0].material = first;
    spheres[1].material = second;
    return without_twins(scene_of(spheres, {})).close_lamps;
}

TEST(CloseLamps, AreLessThanAQuarterOfTheirRadiiApart) {
    EXPECT_FALSE(close_lamps({0, 0, 0}, 1, plain, plain));
    for (const auto &[first, second] : {std::pair{glowing, plain}, {plain, glowing}, {glowing, glowing}}) {
        EXPECT_TRUE(close_lamps({0.2, 0, 0}, 1, first, second));
        EXPECT_TRUE(close_lamps({0, 0.1, 0}, 1.1, first, second));
        EXPECT_FALSE(close_lamps({0.26, 0, 0}, 1, first, second));
        EXPECT_FALSE(close_lamps({0, 0, 0}, 0.7, first, second));
    }
}

TEST(CloseLamps, MayBeInCapsules) {
    const auto close = [](double aside, double radius, pt::Kind kind) {
        Sphere lamp = ball({aside, 3, -5}, 1);
        lamp.material = glowing;
        Sphere rod = ball({0, -9, -5}, radius, {0, 20, 0});
        rod.kind = kind;
        return without_twins(scene_of({lamp, rod}, {})).close_lamps;
    };
    EXPECT_TRUE(close(0.2, 1, pt::Kind::capsule));
    EXPECT_FALSE(close(0.2, 1, pt::Kind::ball));
    EXPECT_FALSE(close(0.26, 1, pt::Kind::capsule));
    EXPECT_FALSE(close(0, 0.7, pt::Kind::capsule));
}

} // namespace
