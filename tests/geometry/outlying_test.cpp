#include "lib/tree/tree_choice.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace outlying {

namespace {

std::vector<pt_sphere> heap(std::size_t count) {
    std::mt19937 engine(11);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    std::vector<pt_sphere> spheres;
    for (std::size_t i = 0; i < count; ++i)
        spheres.push_back({{share(engine), share(engine), share(engine)}, 0.1, {0, 0, 0}, 0, 0});
    return spheres;
}

const std::vector<pt::Material> one_material(1);

std::vector<std::uint32_t> outlying_of(const std::vector<pt_sphere> &spheres) {
    pt::WorkProgress nobody;
    return pt::tree_choice(pt::SphereSource(spheres, {}), one_material, nobody).left_out;
}

using Indices = std::vector<std::uint32_t>;

TEST(Outlying, AreAGroundASunAndWhatMovesFarAway) {
    std::vector<pt_sphere> spheres = heap(1000);
    EXPECT_EQ(outlying_of(spheres), Indices());
    spheres[3] = {{0, -1e6, 0}, 1e6 - 1, {0, 0, 0}, 0, 0};
    EXPECT_EQ(outlying_of(spheres), Indices({3}));
    spheres[900] = {{0, 1e9, 0}, 1, {0, 0, 0}, 0, 0};
    spheres[0].motion[1] = 1000;
    EXPECT_EQ(outlying_of(spheres), Indices({0, 3, 900}));
    spheres[1].center[0] = 15; // less than 16 times the distance of all other spheres
    EXPECT_EQ(outlying_of(spheres), Indices({0, 3, 900}));
}

TEST(Outlying, AreFiftyAtTheMost) {
    for (const std::uint32_t far : {17U, 50U, 51U}) {
        std::vector<pt_sphere> spheres = heap(300);
        Indices expected;
        for (std::uint32_t i = 0; i < far; ++i) {
            spheres[5 * i].center[0] = 1e4 + i;
            expected.push_back(5 * i);
        }
        EXPECT_EQ(outlying_of(spheres), far <= 50 ? expected : Indices()) << far;
    }
}

TEST(Outlying, LeaveHalfOfTheSpheres) {
    std::vector<pt_sphere> spheres = heap(1);
    EXPECT_EQ(outlying_of(spheres), Indices());
    spheres.push_back({{1e6, 0, 0}, 1, {0, 0, 0}, 0, 0});
    EXPECT_LE(outlying_of(spheres).size(), 1U);
    EXPECT_EQ(outlying_of(std::vector<pt_sphere>(50, spheres[0])), Indices()) << "all are equal";
    for (const std::size_t count : {2U, 3U, 7U, 40U}) {
        std::vector<pt_sphere> progression = heap(count);
        for (std::size_t i = 0; i < count; ++i)
            progression[i].center[0] = std::pow(100.0, static_cast<double>(i % 8));
        EXPECT_LE(outlying_of(progression).size(), count / 2);
    }
}

TEST(TreeChoice, HasTheExtentOfTheTreesSpheresAlone) {
    std::vector<pt_sphere> spheres = heap(1000);
    for (const std::size_t i : {3U, 255U, 256U, 700U})
        spheres[i].center[1] = 1e4;
    spheres[701].material = 1; // a lamp
    spheres[702].material = 2; // hidden
    spheres[702].radius = 9;
    std::vector<pt::Material> materials(3);
    materials[1].emission.r = 1.0F;
    materials[2].hidden = true;
    const pt::SphereSource source(spheres, {});
    pt::WorkProgress nobody;
    const pt::TreeChoice choice = pt::tree_choice(source, materials, nobody);
    EXPECT_EQ(choice.left_out, Indices({3, 255, 256, 700, 702}));
    EXPECT_EQ(choice.hidden_count, 1U);
    pt::SphereExtent expected;
    for (std::uint32_t i = 0; i < source.size(); ++i)
        if (std::ranges::find(choice.left_out, i) == choice.left_out.end())
            expected.add(source[i], i == 701);
    EXPECT_EQ(choice.extent.box.low, expected.box.low);
    EXPECT_EQ(choice.extent.box.high, expected.box.high);
    EXPECT_EQ(choice.extent.largest_radius, 0.1);
    EXPECT_EQ(choice.extent.lamp_count, 1U);
}

TEST(TreeChoice, KnowsWhichMaterialsAreUsed) {
    const std::vector<float> center(3 * 4);
    const std::uint32_t materials[] = {7, 5, 7, 5, 3, 2};
    std::vector<pt_sphere_array> arrays(
        4, array_of(4, {center.data(), 12, PT_TYPE_FLOAT32}, {center.data(), 0, PT_TYPE_FLOAT32}));
    arrays[0].material = {&materials[0], 4, PT_TYPE_UINT32};
    arrays[1].material = {&materials[4], 0, PT_TYPE_UINT32};
    arrays[2].material = {&materials[5], 0, PT_TYPE_UINT32};
    arrays[2].count = 0;
    const std::vector<pt_sphere> structs(2, {{9, 9, 9}, 3, {1, 0, 0}, 1, 0});
    pt::WorkProgress nobody;
    const pt::TreeChoice choice =
        pt::tree_choice(pt::SphereSource(structs, arrays), std::vector<pt::Material>(8), nobody);
    EXPECT_EQ(choice.used_materials, (std::vector<bool>{true, true, false, true, false, true, false, true}));
}

} // namespace

} // namespace outlying
