// The grid of a tree: steps are powers of two, places are exact to half a step and within reach.
#include "lib/tree/grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

constexpr double extents[] = {1e-18, 3e-7, 0.5, 1.0, 1.0000001, 12345.678, 1e9, 1e18};

TEST(Grid, HasTheFinestPowerOfTwoThatReaches) {
    for (const double extent : extents) {
        const pt::Grid grid(glm::dvec3(0.0), extent);
        int exponent = 0;
        EXPECT_EQ(std::frexp(grid.step, &exponent), 0.5) << extent;
        EXPECT_GE(pt::Grid::reach * grid.step, extent);
        EXPECT_LE(pt::Grid::reach * grid.step, 2.0 * extent); // twice only where the extent itself is a power of two
    }
}

TEST(Grid, PlacesAreTheNextOnesWithinReach) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    for (const double extent : extents) {
        const glm::dvec3 middle = 4.0 * extent * glm::dvec3(share(engine), share(engine), share(engine));
        const pt::Grid grid(middle, extent);
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 from = extent * glm::dvec3(share(engine), share(engine), i % 2 == 0 ? 1.0 : -1.0);
            const glm::dvec3 point = middle + from;
            const glm::ivec3 place = grid.place(point);
            // A point so near to the middle is rounded to 2^-50 of the extent, a 2^20th of a step.
            const glm::dvec3 off = glm::abs(grid.point(place) - point) / grid.step;
            EXPECT_LE(std::max({off.x, off.y, off.z}), 0.5 + 0x1p-18) << extent;
            const glm::ivec3 size = glm::abs(place);
            EXPECT_LE(std::max({size.x, size.y, size.z}), static_cast<int>(pt::Grid::reach)) << extent;
        }
    }
}

// What the kernel needs so that nothing is lost, whichever two places it takes the difference of.
TEST(Grid, DifferencesOfPlacesAndOfACameraTwiceAsFarAwayAre32BitNumbers) {
    const pt::Grid grid(glm::dvec3(0.0), 1.0);
    const double far = 2.0 * pt::Grid::reach * grid.step;
    const std::int64_t camera = grid.place({far, -far, far}).x;
    const std::int64_t sphere = grid.place({-1.0, 1.0, -1.0}).x;
    EXPECT_LE(camera - sphere, std::int64_t{INT32_MAX});
    EXPECT_EQ(camera, std::int64_t{1} << 30);
}

TEST(GridBox, MeetsWhatSharesAPlace) {
    pt::GridBox box;
    EXPECT_FALSE(pt::meet(box, {glm::ivec3(-10), glm::ivec3(10)})) << "holds nothing";
    box.add(glm::ivec3(1, 2, 3));
    box.add(pt::GridBox{glm::ivec3(-1), glm::ivec3(0)});
    EXPECT_EQ(box, (pt::GridBox{glm::ivec3(-1), glm::ivec3(1, 2, 3)}));
    EXPECT_EQ(box.extent(), glm::vec3(2, 3, 4));
    for (int axis = 0; axis < 3; ++axis) {
        pt::GridBox beside = box;
        beside.low[axis] = box.high[axis];
        beside.high[axis] = box.high[axis] + 5;
        EXPECT_TRUE(pt::meet(box, beside));
        ++beside.low[axis];
        EXPECT_FALSE(pt::meet(box, beside));
        EXPECT_FALSE(pt::meet(beside, box));
    }
}

} // namespace
