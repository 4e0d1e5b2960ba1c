#include "tests/geometry/heap_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sphere_trees {

namespace {

using namespace heap_tree;

TEST(SphereTree, BoxesHoldTheirSpheresAtAllTimes) {
    for (const double motion : {0.0, 1e-3, 2.0}) {
        const pt::SphereTree tree = tree_of(heap(2000, motion));
        EXPECT_EQ(tree.sphere_count(), 2000U);
        EXPECT_EQ(tree.moves(), motion > 0.0);
        expect_all_held(tree, 2000);
    }
}

// Radii and motions of up to 2^30 steps have relative rounding errors of up to 2^-24.
TEST(SphereTree, StaysWithinReach) {
    for (const double scale : {1e-18, 1.0, 1e17})
        for (const double motion : {0.0, 1.0}) {
            std::vector<pt_sphere> spheres = heap(100, motion);
            for (pt_sphere &sphere : spheres) {
                sphere.radius *= scale;
                for (int axis = 0; axis < 3; ++axis) {
                    sphere.center[axis] *= scale;
                    sphere.motion[axis] *= scale;
                }
            }
            spheres[0].radius = 3 * scale / 1.0000003;
            const pt::SphereTree tree = tree_of(spheres);
            const pt::PointBox bounds = tree.bounds();
            const double reach = (pt::Grid::reach + 98.0) * tree.grid().step;
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_LE(bounds.high[axis] - tree.grid().middle[axis], reach);
                EXPECT_GE(bounds.low[axis] - tree.grid().middle[axis], -reach);
            }
        }
}

TEST(SphereTree, HasStepsThatSuitBallsAllInOnePoint) {
    std::vector<pt_sphere> spheres;
    for (int i = 0; i < 40; ++i)
        spheres.push_back({{1e6, 0, 0}, 1e-12 * (40 + i), {0, 0, 0}, 0, 0});
    EXPECT_LT(tree_of(spheres).grid().step, 1e-18);
}

TEST(SphereTree, KeepsTheFirstOfTwins) {
    std::vector<pt_sphere> spheres = heap(100, 0.0);
    spheres[0].center[0] = 100; // 2^-22 of this distance is 2^7 steps.
    const pt_sphere forth{{5.5, 0, -3}, 0.1, {0.25, 0, 0}, 0, 0};
    const pt_sphere back{{5.75, 0, -3}, 0.1, {-0.25, -0.0, 0}, 0, 0};
    for (int i = 0; i < 5; ++i) {
        spheres.push_back(forth);
        spheres.back().center[0] += i * 1e-12; // too little to change the stored position
        spheres.back().material = i == 0 ? 1 : 0;
        spheres.push_back(back);
        spheres.back().motion[2] = i % 2 == 0 ? 0.0 : -0.0;
    }
    const pt::SphereTree tree = tree_of(spheres);
    EXPECT_EQ(tree.sphere_count(), 102U);
    EXPECT_EQ(tree.lamp_materials().size(), 11U) << "not the first one was kept";
}

TEST(SphereTree, TellsWhetherItMayHoldACamera) {
    std::vector<pt_sphere> spheres = heap(300, 0.0);
    spheres.push_back({{20, 0, 0}, 2, {0, 0, 0}, 0, 0});
    spheres.push_back({{0, 30, 0}, 1, {10, 0, 0}, 0, 0});
    const pt::SphereTree tree = tree_of(spheres);
    EXPECT_TRUE(tree.may_hold(camera_at({20, 0, 0})));
    EXPECT_TRUE(tree.may_hold(camera_at({20, 1.9, 0})));
    EXPECT_TRUE(tree.may_hold(camera_at({20, 2.0 * (1.0 + 0x1p-17), 0}))) << "float32 may not tell";
    EXPECT_FALSE(tree.may_hold(camera_at({20, 2.0 * (1.0 + 0x1p-14), 0})));
    EXPECT_FALSE(tree.may_hold(camera_at({1e12, 0, 0})));
    EXPECT_FALSE(tree.may_hold(camera_at({-1e300, 1e300, 0})));
    const glm::dvec3 on_the_way(5, 30.5, 0);
    EXPECT_TRUE(tree.may_hold(camera_at(on_the_way)));
    EXPECT_TRUE(tree.may_hold(camera_at(on_the_way, 0.5, 0.5)));
    EXPECT_TRUE(tree.may_hold(camera_at(on_the_way, 0.3, 0.6)));
    EXPECT_FALSE(tree.may_hold(camera_at(on_the_way, 0.0, 0.2)));
    EXPECT_FALSE(tree.may_hold(camera_at(on_the_way, 0.7, 1.0)));
}

TEST(SphereTree, KnowsLampsThatNearlyCoincideWithSpheres) {
    std::vector<pt_sphere> spheres;
    for (int i = 0; i < 40; ++i)
        spheres.push_back({{3.0 * i, 0, 0}, 1, {0, 0, 0}, i == 20 ? 1U : 0U, 0});
    EXPECT_FALSE(tree_of(spheres).has_close_lamps());
    spheres.push_back({{3, 0.01, 0}, 1, {0, 0, 0}, 0, 0});
    EXPECT_FALSE(tree_of(spheres).has_close_lamps()) << "neither is a lamp";
    for (const double apart : {0.24, 0.26}) {
        spheres.back() = {{60, apart, 0}, 1, {0, 0, 0}, 0, 0};
        EXPECT_EQ(tree_of(spheres).has_close_lamps(), apart < 0.25) << "beside it by " << apart;
        spheres.back() = {{60, 0, 0}, 1 + apart, {0, 0, 0}, 0, 0};
        EXPECT_EQ(tree_of(spheres).has_close_lamps(), apart < 0.25) << "about it by " << apart;
        spheres.back() = {{60, 0, 0}, 1, {0, apart, 0}, 0, 0};
        EXPECT_EQ(tree_of(spheres).has_close_lamps(), apart < 0.25) << "moves by " << apart;
    }
}

pt::SphereTree tree_with(const pt_sphere_array &capsules, const std::vector<pt_sphere> &spheres,
                         const std::vector<std::uint32_t> &left_out = {}) {
    return tree_of(pt::SphereSource(spheres, {&capsules, 1}), left_out);
}

TEST(SphereTree, KnowsLampsInCapsules) {
    std::vector<pt_sphere> spheres = heap(40, 0.0);
    for (pt_sphere &sphere : spheres)
        sphere.material = 0;
    spheres.push_back({{60, 0.2, 0}, 1, {0, 0, 0}, 1, 0});
    const double first[] = {30, 0, 0};
    const double last[] = {90, 0, 0};
    for (const double radius : {0.7, 1.0}) {
        const pt_sphere_array capsule{
            sizeof(pt_sphere_array),    1, {first, 0, PT_TYPE_FLOAT64}, {&radius, 0, PT_TYPE_FLOAT64}, {}, {}, {},
            {last, 0, PT_TYPE_FLOAT64}, {}};
        EXPECT_EQ(tree_with(capsule, spheres).has_close_lamps(), radius > 0.9);
    }
}

TEST(SphereTree, HasWaysIfWhatIsLeftOutMoves) {
    const auto has_ways = [](const pt::SphereTree &tree) {
        const pt::gpu::TreeFrame frame = tree.frame(camera_at(glm::dvec3(0.0)));
        return frame.first_surface == frame.first_motion + tree.sphere_count();
    };
    const double radius = 1.0;
    const double last[] = {3, 0, 0};
    std::vector<pt_sphere> spheres = heap(100, 0.0);
    pt_sphere_array one{sizeof(pt_sphere_array),
                        1,
                        {spheres[0].center, 0, PT_TYPE_FLOAT64},
                        {&radius, 0, PT_TYPE_FLOAT64},
                        {},
                        {},
                        {},
                        {},
                        {}};
    EXPECT_FALSE(has_ways(tree_with(one, spheres, {0, 100})));
    one.end = {last, 0, PT_TYPE_FLOAT64};
    EXPECT_FALSE(has_ways(tree_with(one, spheres, {0, 100})));
    EXPECT_TRUE(has_ways(tree_with(one, spheres, {0})));
    one.end = {};
    spheres[0].motion[0] = 1.0;
    EXPECT_TRUE(has_ways(tree_with(one, spheres, {0, 100})));
}

// A sphere lies at (p - camera) step + shift. The error comes from rounding shift, which is about as long as the
// distance of a far camera.
TEST(SphereTree, FramesPutSpheresWhereTheyAre) {
    const std::vector<pt_sphere> spheres = heap(100, 0.0);
    const pt::SphereTree tree = tree_of(spheres);
    const double step = tree.grid().step;
    for (const glm::dvec3 &position : {glm::dvec3(5, 0.1, -3), glm::dvec3(6.1, 0.3, -2), glm::dvec3(5, 3, 1e3)}) {
        const pt::gpu::TreeFrame frame = tree.frame(camera_at(position));
        const bool far = position.z > 100;
        EXPECT_EQ(frame.camera == glm::ivec3(0), far);
        const double bound = 0.5 * step + (far ? 0x1p-24 * 1e3 : 0x1p-24 * step) + 1e-15;
        for (const std::uint32_t lamp : {0U, 4U, 9U}) {
            const std::uint32_t place = tree.sphere_words()[frame.first_lamp + lamp].x;
            const glm::dvec3 from_camera =
                glm::dvec3(held(tree, place).center - frame.camera) * step + glm::dvec3(frame.shift);
            const pt_sphere &sphere = spheres[10 * lamp + 3];
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_LE(std::abs(from_camera[axis] - (sphere.center[axis] - position[axis])), bound);
        }
    }
}

} // namespace

} // namespace sphere_trees
