#include "tests/geometry/heap_tree.h"
#include "tests/support/sized.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace sphere_trees {

namespace {

using namespace heap_tree;

// Radii and motions of up to 2^30 steps have relative rounding errors of up to 2^-24.
TEST(SphereTree, BoxesHoldTheirSpheresAtAllTimesAndStayWithinReach) {
    for (const double scale : {1e-18, 1.0, 1e17})
        for (const double motion : {0.0, 1e-3, 2.0}) {
            SCOPED_TRACE(testing::Message() << "scale " << scale << ", motion " << motion);
            std::vector<pt_sphere> spheres = heap(2000, motion);
            for (pt_sphere &sphere : spheres) {
                sphere.radius *= scale;
                for (int axis = 0; axis < 3; ++axis) {
                    sphere.center[axis] *= scale;
                    sphere.motion[axis] *= scale;
                }
            }
            spheres[0].radius = 3 * scale / 1.0000003;
            const pt::SphereTree tree = tree_of(spheres);
            EXPECT_EQ(tree.sphere_count(), 2000U);
            EXPECT_EQ(tree.moves(), motion > 0.0);
            expect_all_held(tree, 2000);
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

pt::SphereTree tree_with(const double (&first)[3], const double (&last)[3], double radius,
                         const std::vector<pt_sphere> &spheres, const std::vector<std::uint32_t> &left_out = {}) {
    auto capsule = sized<pt_sphere_array>();
    capsule.count = 1;
    capsule.center = {first, 0, PT_TYPE_FLOAT64};
    capsule.radius = {&radius, 0, PT_TYPE_FLOAT64};
    capsule.end = {last, 0, PT_TYPE_FLOAT64};
    return tree_of(pt::SphereSource(spheres, {&capsule, 1}), left_out);
}

TEST(SphereTree, KnowsLampsThatNearlyCoincideWithSpheres) {
    std::vector<pt_sphere> spheres;
    for (int i = 0; i < 40; ++i)
        spheres.push_back({{3.0 * i, 0, 0}, 1, {0, 0, 0}, i == 20 ? 1U : 0U, 0});
    EXPECT_FALSE(tree_of(spheres).has_close_lamps());
    for (const double radius : {0.7, 1.0})
        EXPECT_EQ(tree_with({60, -30, 0.2}, {60, 30, 0.2}, radius, spheres).has_close_lamps(), radius > 0.9);
    spheres.push_back({{3, 0.01, 0}, 1, {0, 0, 0}, 0, 0});
    EXPECT_FALSE(tree_of(spheres).has_close_lamps()) << "neither is a lamp";
    for (const double apart : {0.24, 0.26})
        for (const pt_sphere &close : {pt_sphere{{60, apart, 0}, 1, {0, 0, 0}, 0, 0},
                                       {{60, 0, 0}, 1 + apart, {0, 0, 0}, 0, 0},
                                       {{60, 0, 0}, 1, {0, apart, 0}, 0, 0}}) {
            spheres.back() = close;
            EXPECT_EQ(tree_of(spheres).has_close_lamps(), apart < 0.25) << apart;
        }
}

// Kernels read all motions or none.
TEST(SphereTree, HasWaysIfWhatIsLeftOutMoves) {
    const auto has_ways = [](const pt::SphereTree &tree) {
        const pt::gpu::TreeFrame frame = tree.frame(camera);
        return frame.first_surface == frame.first_motion + tree.sphere_count();
    };
    std::vector<pt_sphere> spheres = heap(100, 0.0);
    EXPECT_FALSE(has_ways(tree_with({0, 0, 0}, {3, 0, 0}, 1, spheres, {0, 100})));
    EXPECT_TRUE(has_ways(tree_with({0, 0, 0}, {3, 0, 0}, 1, spheres, {0})));
    spheres[0].motion[0] = 1.0;
    EXPECT_TRUE(has_ways(tree_with({0, 0, 0}, {3, 0, 0}, 1, spheres, {0, 100})));
}

} // namespace

} // namespace sphere_trees
