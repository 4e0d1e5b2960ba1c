#include "lib/scene/checked_scene.h"
#include "lib/view/displacement.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace displacements {

namespace {

struct Surface {
    glm::dvec3 center;
    double radius;
    float opacity = 1.0F;
};

constexpr float half = 0.5F;

// A pixel's side is 1/512 of its distance. Bounds of depths make it up to 0.8% smaller.
constexpr pt::RenderSettings square{64, 64, 2, 0, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_RANDOM, 0, 64};
const pt::Camera ahead{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.0625, 0.0, 1.0};

template <typename Element>
pt_column column_of(const Element &first, std::uint32_t type) {
    return {&first, sizeof(Surface), type};
}

pt_sphere_array array_of(const std::vector<Surface> &surfaces) {
    pt_sphere_array array = array_of(surfaces.size(), column_of(surfaces[0].center, PT_TYPE_FLOAT64),
                                     column_of(surfaces[0].radius, PT_TYPE_FLOAT64));
    array.opacity = column_of(surfaces[0].opacity, PT_TYPE_FLOAT32);
    return array;
}

std::string displaced(const pt_sphere_array &array, const pt::Camera &camera = ahead) {
    const pt_material black{};
    const auto rule = pt::displaced_surface(
        prepared_scene_of(checked_scene_of(scene_of({&black, 1}, {}, {}, {&array, 1})), 113), camera, square);
    return rule ? rule->text() : "";
}

std::string displaced(const std::vector<Surface> &surfaces) {
    return displaced(array_of(surfaces));
}

std::string displaced_capsule(const glm::dvec3 &center, const glm::dvec3 &end, double radius,
                              const pt::Camera &camera = ahead) {
    const Surface ball{center, radius};
    pt_sphere_array array = array_of({ball});
    array.center = {&center, 0, PT_TYPE_FLOAT64};
    array.radius = {&radius, 0, PT_TYPE_FLOAT64};
    array.opacity = {};
    array.end = {&end, 0, PT_TYPE_FLOAT64};
    return displaced(array, camera);
}

TEST(Displacement, OfSpheresThatShareAGridWithADistantOne) {
    // The grid reaches from -4 to -1e9 - 1. Its steps are 1, so centers move by up to half the diagonal of a unit cube.
    // The near sphere's center becomes -4.5, and a pixel at -3.5 has the side 1 / 146.3.
    const std::string rule = displaced({{{0, 0, -5}, 1, half}, {{0, 0, -1e9}, 1, half}});
    EXPECT_TRUE(rule.starts_with("sphere_arrays[0].center[1] = (0, 0, -1e+09): it reaches so far that centers "
                                 "are stored to 0.866, which moves some in view by up to 126.7 pixels in the "
                                 "picture: "))
        << rule;
    EXPECT_NE(displaced({{{0, 0, -5}, 1, half}, {{0, 0, -1e7}, 1, half}}), "") << "1.7 pixels";
    EXPECT_EQ(displaced({{{0, 0, -5}, 1, half}, {{0, 0, -5e6}, 1, half}}), "") << "0.87 pixels";
    EXPECT_EQ(displaced({{{0, 0, 5}, 1, half}, {{0, 0, 1e9}, 1, half}}), "") << "behind the camera";
    EXPECT_EQ(displaced({{{0, 0, -5}, 1, 0.999F}, {{0, 0, -1e9}, 1, 0.999F}}), "") << "no tree of opaque spheres";
    EXPECT_NE(displaced({{{0, 0, -5}, 1, 0.99F}, {{0, 0, -1e9}, 1, 0.99F}}), "");
}

// Radii have a relative error of 2^-16. The error of the radius 1024 is 1 / 64, the side of a pixel at distance 8.
TEST(Displacement, OfTranslucentRadii) {
    const auto ball = [](double radius) { return Surface{{0, 0, -radius - 8.0}, radius, half}; };
    EXPECT_EQ(displaced({ball(1000)}), "");
    const std::string rule = displaced({ball(1050)});
    EXPECT_TRUE(rule.starts_with("sphere_arrays[0].radius[0] = 1050: in scenes with opacities radii are stored "
                                 "to 2^-16 of themselves"))
        << rule;
    const std::string of_ground = displaced({{{0, 0, -5}, 1, half}, {{0, -1e8 - 2, 0}, 1e8, half}});
    EXPECT_TRUE(of_ground.starts_with("sphere_arrays[0].radius[1] = 1e+08: ")) << of_ground;
}

// The capsule passes at a distance of 1, where a pixel's side is 1 / 512. Capsules are stored to 2^-21 of their length,
// so the longest permitted one has the length 2^12.
TEST(Displacement, OfLongCapsules) {
    const auto passing = [](double length) {
        return displaced_capsule({-0.5 * length, 0, -1.5}, {0.5 * length, 0, -1.5}, 0.5);
    };
    EXPECT_EQ(passing(1), "");
    EXPECT_EQ(passing(3200), ""); // The capsule's bound may be nearer by an eighth.
    const std::string rule = passing(4200);
    EXPECT_TRUE(rule.starts_with("sphere_arrays[0].end[0] = (2100, 0, -1.5): the capsule is 4200 long and "
                                 "stored to 2^-21 of its length"))
        << rule;
    EXPECT_EQ(displaced_capsule({-1e6, 0, 1.5}, {1e6, 0, 1.5}, 0.5), "") << "behind the camera";
    EXPECT_EQ(displaced_capsule({0, 0, -1e6}, {1e5, 0, -1e6}, 0.5), "") << "far away";
    pt::Camera parallel = ahead;
    parallel.view_size = 2.0;
    parallel.projection = PT_PROJECTION_ORTHOGRAPHIC;
    EXPECT_NE(displaced_capsule({-1e5, 0, -1e6}, {1e5, 0, -1e6}, 0.5, parallel), "");
    EXPECT_EQ(displaced_capsule({-1e5, 9, -1e6}, {1e5, 9, -1e6}, 0.5, parallel), "") << "beside the picture";
}

} // namespace

} // namespace displacements
