// The depth of a tree must fit into the kernel's stack for any input.
#include "lib/tree/sphere_order.h"
#include "shaders/gpu_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace sphere_orders {

namespace {

using Ball = std::array<float, 4>;

std::vector<pt::TreeItem> items_of(std::uint32_t count, const std::function<Ball(std::uint32_t)> &ball) {
    std::vector<pt::TreeItem> items;
    for (std::uint32_t i = 0; i < count; ++i)
        items.push_back({ball(i), i});
    return items;
}

const pt::BitsOfSphere own_number = [](std::uint32_t sphere) { return pt::SphereBits{sphere}; };

pt::TreeShape shape_of(std::vector<pt::TreeItem> items, const pt::BitsOfSphere &bits_of) {
    pt::WorkProgress nobody;
    return pt::tree_shape(std::move(items), bits_of, nobody);
}

void expect_well_linked(const pt::TreeShape &shape) {
    std::vector<std::uint32_t> depths(shape.nodes.size(), 0);
    std::vector<bool> placed(shape.spheres.size());
    depths[0] = 1;
    std::uint32_t deepest = 0;
    for (std::size_t node = 0; node < shape.nodes.size(); ++node) {
        const pt::TreeLinks &links = shape.nodes[node];
        ASSERT_GT(depths[node], 0U) << "a node before the one whose child it is";
        deepest = std::max(deepest, depths[node]);
        ASSERT_LE(links.inner_count, links.child_count);
        ASSERT_LE(links.child_count, pt::tree_width);
        ASSERT_GE(links.child_count, shape.nodes.size() > 1 ? 2 : 1);
        for (std::uint32_t i = 0; i < links.inner_count; ++i) {
            ASSERT_GT(links.first_child + i, node);
            ASSERT_LT(links.first_child + i, shape.nodes.size());
            ASSERT_EQ(depths[links.first_child + i], 0U) << "a child of two nodes";
            depths[links.first_child + i] = depths[node] + 1;
        }
        for (std::uint32_t i = links.inner_count; i < links.child_count; ++i) {
            const std::uint32_t place = links.first_place + i - links.inner_count;
            ASSERT_LT(place, placed.size());
            ASSERT_FALSE(placed[place]) << "a place of two nodes";
            placed[place] = true;
        }
    }
    EXPECT_TRUE(std::ranges::all_of(placed, [](bool is) { return is; }));
    EXPECT_EQ(shape.depth, deepest);
    EXPECT_LE(shape.depth, pt::gpu::TREE_STACK_SIZE);
}

void expect_each_once(std::vector<std::uint32_t> spheres, std::uint32_t count) {
    ASSERT_EQ(spheres.size(), count);
    std::ranges::sort(spheres);
    for (std::uint32_t i = 0; i < count; ++i)
        ASSERT_EQ(spheres[i], i);
}

struct Kind {
    const char *name;
    std::function<Ball(std::uint32_t)> ball;
};

constexpr std::uint32_t many = 100'000;

Ball ball_at(float x, float y, float z, float radius) {
    return {x, y, z, radius};
}

std::vector<Kind> kinds() {
    const auto share = [](std::uint32_t i) { return static_cast<float>(i) / static_cast<float>(many); };
    const auto spread = [=](std::uint32_t i) { return std::exp2(60 * share(i) - 30); };
    const auto along = [=](std::uint32_t i, std::uint32_t axis) { return i % 3 == axis ? spread(i) : 0.0F; };
    return {{"one point", [=](std::uint32_t i) { return ball_at(1, 2, 3, 1 + share(i)); }},
            {"one point, radii in progression",
             [=](std::uint32_t i) { return ball_at(0, 0, 0, std::exp2(20 * share(i))); }},
            {"equal", [](std::uint32_t) { return ball_at(1, 2, 3, 4); }},
            {"progression", [=](std::uint32_t i) { return ball_at(std::exp2(120 * share(i) - 90), 0, 0, 1e-30F); }},
            {"progression of balls that touch",
             [=](std::uint32_t i) { return ball_at(spread(i), 0, 0, spread(i) * 1e-4F); }},
            {"progression in space",
             [=](std::uint32_t i) { return ball_at(along(i, 0), along(i, 1), along(i, 2), spread(i) * 0.1F); }},
            {"progression of points, each many times",
             [](std::uint32_t i) { return ball_at(std::exp2(static_cast<float>(i % 60)), 0, 0, 1.0F); }},
            {"line", [=](std::uint32_t i) { return ball_at(share(i), 0, 0, 1e-6F); }},
            {"line backwards", [=](std::uint32_t i) { return ball_at(0, -share(i), 0, 1e-6F); }},
            {"one huge",
             [=](std::uint32_t i) { return ball_at(share(i * 7919 % many), share(i), 0, i == 5 ? 1e9F : 1e-3F); }},
            {"all but one at one point",
             [=](std::uint32_t i) { return ball_at(i == many / 3 ? 5.0F : 1.0F, 2, 3, 1 + share(i)); }},
            {"two heaps", [=](std::uint32_t i) { return ball_at((i % 2 == 0 ? 1e9F : 0) + share(i), 0, 0, 1); }}};
}

TEST(SphereOrder, GivesEachSphereOnePlaceInATreeThatTheStackHolds) {
    for (const Kind &kind : kinds())
        for (const std::uint32_t count : {1U, 2U, 4U, 5U, 17U, 1000U, many}) {
            SCOPED_TRACE(std::string(kind.name) + ", " + std::to_string(count));
            const pt::TreeShape shape = shape_of(items_of(count, kind.ball), own_number);
            expect_each_once(shape.spheres, count);
            expect_well_linked(shape);
        }
}

TEST(SphereOrder, LeavesTheFirstOfTwins) {
    constexpr std::uint32_t different = 3 * 50;
    const auto ball = [](std::uint32_t i) {
        const std::uint32_t point = i % different / 3;
        return Ball{std::exp2(2.0F * static_cast<float>(point) - 60.0F), 0, 0, 1e-20F};
    };
    const auto kind = [](std::uint32_t i) { return pt::SphereBits{i % different}; };
    const pt::TreeShape shape = shape_of(items_of(20 * different, ball), kind);
    expect_each_once(shape.spheres, different);
    expect_well_linked(shape);
}

struct Told {
    std::vector<double> shares;
    double stop_at = 2.0;

    static std::int32_t receive(void *user, double share) {
        auto *const told = static_cast<Told *>(user);
        told->shares.push_back(share);
        return share >= told->stop_at ? 1 : 0;
    }
};

TEST(SphereOrder, EndsWhereItIsAskedTo) {
    for (const Kind &kind : kinds()) {
        SCOPED_TRACE(kind.name);
        Told told{.shares = {}, .stop_at = 0.0};
        pt::WorkProgress progress(&Told::receive, &told);
        progress.enter(1.0, many);
        EXPECT_THROW(pt::tree_shape(items_of(many, kind.ball), own_number, progress), pt::Cancelled);
        EXPECT_EQ(told.shares.size(), 1U);
        EXPECT_LT(told.shares.back(), 0.5);
    }
}

} // namespace

} // namespace sphere_orders
