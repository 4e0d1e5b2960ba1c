#include "tests/geometry/heap_tree.h"

#include "lib/view/prepared_scene.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace kept_shapes {

namespace {

using namespace heap_tree;
using Spheres = std::vector<pt_sphere>;

constexpr std::size_t ball_count = 2000;

Spheres moved(Spheres spheres, double by) {
    std::mt19937 engine(29);
    std::normal_distribution<double> normal;
    for (pt_sphere &sphere : spheres)
        for (double &coordinate : sphere.center)
            coordinate += by * normal(engine);
    return spheres;
}

std::optional<pt::SphereTree> kept(const pt::SphereTree &other, const pt::SphereSource &spheres,
                                   const std::vector<std::uint32_t> &left_out = {}) {
    pt::WorkProgress nobody;
    return pt::SphereTree::with_shape_of(other, spheres, choice_without(left_out, spheres), two_materials, nobody);
}

std::optional<pt::SphereTree> kept(const pt::SphereTree &other, const Spheres &spheres,
                                   const std::vector<std::uint32_t> &left_out = {}) {
    return kept(other, pt::SphereSource(spheres, {}), left_out);
}

std::string digest_of(const pt::SphereTree &tree) {
    pt::Digest digest;
    tree.add_to(digest);
    return digest.text();
}

void expect_alike(const pt::SphereTree &tree, const pt::SphereTree &other) {
    EXPECT_EQ(tree.lamp_materials(), other.lamp_materials());
    EXPECT_EQ(tree.bounds().low, other.bounds().low);
    EXPECT_EQ(tree.bounds().high, other.bounds().high);
    EXPECT_EQ(tree.has_close_lamps(), other.has_close_lamps());
    for (std::uint32_t lamp = 0; lamp < tree.lamp_materials().size(); ++lamp)
        EXPECT_EQ(tree.lamp(lamp).center, other.lamp(lamp).center);
    EXPECT_EQ(digest_of(tree), digest_of(other));
}

class KeptShape : public testing::Test {
protected:
    const Spheres spheres_ = heap(ball_count, 0.0);
    const pt::SphereTree tree_ = tree_of(spheres_);
};

TEST_F(KeptShape, HoldsSpheresThatHaveMoved) {
    for (const double motion : {0.0, 0.02}) {
        const Spheres spheres = heap(ball_count, motion);
        const pt::SphereTree tree = tree_of(spheres);
        for (const double by : {0.0, 0.01, 0.03}) {
            const Spheres now = moved(spheres, by);
            const auto with_shape = kept(tree, now);
            ASSERT_TRUE(with_shape) << by;
            expect_all_held(*with_shape, ball_count);
            expect_alike(*with_shape, tree_of(now));
            EXPECT_EQ(with_shape->depth(), tree.depth());
            EXPECT_EQ(with_shape->node_count(), tree.node_count());
        }
    }
}

TEST_F(KeptShape, IsOfAllThatIsNotPlacesToo) {
    Spheres now = spheres_;
    for (std::size_t i = 0; i < now.size(); ++i) {
        now[i].radius *= i % 2 == 0 ? 1.01 : 0.99;
        now[i].motion[1] = 1e-3;
        now[i].material = i % 7 == 0 ? 1 : 0;
    }
    const auto with_shape = kept(tree_, now);
    ASSERT_TRUE(with_shape);
    expect_all_held(*with_shape, ball_count);
    expect_alike(*with_shape, tree_of(now));

    std::vector<float> colors(3 * ball_count, 0.25F);
    pt_sphere_array array = array_of(ball_count, {spheres_[0].center, sizeof spheres_[0], PT_TYPE_FLOAT64},
                                     {&spheres_[0].radius, sizeof spheres_[0], PT_TYPE_FLOAT64});
    array.color = {colors.data(), 12, PT_TYPE_FLOAT32};
    const pt::SphereSource source({}, {&array, 1});
    const auto colored = kept(tree_, source);
    ASSERT_TRUE(colored);
    expect_alike(*colored, tree_of(source));
}

TEST_F(KeptShape, IsNotForOtherSpheres) {
    EXPECT_TRUE(kept(tree_, spheres_));
    EXPECT_FALSE(kept(tree_, spheres_, {5}));
    Spheres more = spheres_;
    more.push_back({{5, 0, 0}, 0.02, {0, 0, 0}, 0, 0});
    EXPECT_FALSE(kept(tree_, more));
    EXPECT_FALSE(kept(tree_, more, {5})) << "as many, but others";
    Spheres fewer = spheres_;
    fewer.pop_back();
    EXPECT_FALSE(kept(tree_, fewer));

    const pt::SphereTree without_one = tree_of(pt::SphereSource(spheres_, {}), {5});
    EXPECT_TRUE(kept(without_one, spheres_, {5}));
    EXPECT_FALSE(kept(without_one, spheres_, {6}));
    EXPECT_FALSE(kept(without_one, spheres_));
    EXPECT_FALSE(kept(without_one, fewer)) << "as many, but others";
}

TEST_F(KeptShape, IsNotForTwins) {
    Spheres with_twins = spheres_;
    std::ranges::copy(with_twins[7].center, with_twins[1500].center);
    with_twins[1500].radius = with_twins[7].radius;
    EXPECT_FALSE(kept(tree_, with_twins));
    const pt::SphereTree of_twins = tree_of(with_twins);
    EXPECT_EQ(of_twins.sphere_count(), ball_count - 1);
    EXPECT_FALSE(kept(of_twins, spheres_));
    EXPECT_FALSE(kept(of_twins, with_twins));
    // Spheres that move differently are no twins. At equal distances their order decides.
    with_twins[1500].motion[0] = 0.5;
    EXPECT_EQ(tree_of(with_twins).sphere_count(), ball_count);
    EXPECT_FALSE(kept(tree_, with_twins));
}

TEST_F(KeptShape, IsGivenUpWhereANewTreeWouldBeMuchBetter) {
    const auto growth = [&](double by) {
        const auto with_shape = kept(tree_, moved(spheres_, by));
        return with_shape ? with_shape->cost() / tree_.cost() : INFINITY;
    };
    EXPECT_GT(growth(0.02), 1.0);
    EXPECT_GT(growth(0.04), growth(0.02));
    EXPECT_LE(growth(0.04), 1.25);
    EXPECT_EQ(growth(0.1), INFINITY);

    std::optional<pt::SphereTree> last = tree_of(spheres_);
    int steps = 0;
    for (; last && steps < 100; ++steps)
        last = kept(*last, moved(spheres_, 0.005 * steps));
    EXPECT_GT(steps, 5);
    EXPECT_LT(steps, 30);

    Spheres one_away = spheres_;
    one_away[3].center[1] = 14;
    EXPECT_FALSE(kept(tree_, one_away));
    Spheres scaled = spheres_;
    for (pt_sphere &sphere : scaled) {
        sphere.radius *= 3;
        for (double &coordinate : sphere.center)
            coordinate *= 3;
    }
    EXPECT_TRUE(kept(tree_, scaled)) << "all is as it was";
}

TEST_F(KeptShape, IsTakenFromTheSceneBefore) {
    const std::vector<pt::Material> materials(2, pt::Material{glm::vec3(0.5F), glm::vec3(0), glm::vec3(0), 0});
    const auto prepared = [&](const Spheres &spheres, const pt::PreparedScene *before) {
        pt::WorkProgress nobody;
        return pt::PreparedScene({materials, pt::SphereSource(spheres, {}), {}}, 50, before, nobody);
    };
    Spheres spheres = spheres_;
    spheres[100] = {{0, -1e4, 0}, 1e4 - 2, {0, 0, 0}, 0, 0};
    const pt::PreparedScene first = prepared(spheres, nullptr);
    const Spheres later = moved(spheres, 0.02);
    const pt::PreparedScene with_shape = prepared(later, &first);
    const pt::PreparedScene anew = prepared(later, nullptr);
    EXPECT_EQ(with_shape.tree->node_count(), first.tree->node_count());
    EXPECT_NE(with_shape.tree->words(), anew.tree->words());
    EXPECT_EQ(with_shape.digest(), anew.digest());
    EXPECT_NE(with_shape.digest(), first.digest());
    const pt::PreparedScene without_tree = prepared(Spheres(later.begin(), later.begin() + 10), &with_shape);
    EXPECT_FALSE(without_tree.tree);
    EXPECT_EQ(prepared(later, &without_tree).tree->words(), anew.tree->words());
    const std::function<void(pt_sphere &)> changes[] = {
        [](pt_sphere &sphere) { sphere.center[2] += 1e-6; }, [](pt_sphere &sphere) { sphere.radius *= 1.0001; },
        [](pt_sphere &sphere) { sphere.motion[0] = 1e-6; }, [](pt_sphere &sphere) { sphere.material = 1; }};
    for (std::size_t i = 0; i < std::size(changes); ++i) {
        Spheres changed = later;
        changed[777].material = 0;
        const std::string digest = prepared(changed, nullptr).digest();
        changes[i](changed[777]);
        EXPECT_NE(prepared(changed, nullptr).digest(), digest) << i;
    }
}

} // namespace

} // namespace kept_shapes
