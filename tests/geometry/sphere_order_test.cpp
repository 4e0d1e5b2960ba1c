#include "lib/tree/cuts.h"
#include "lib/tree/sphere_order.h"
#include "shaders/gpu_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace sphere_orders {

namespace {

using Ball = std::array<float, 4>;
using Items = std::vector<pt::TreeItem>;

Items items_of(std::uint32_t count, const std::function<Ball(std::uint32_t)> &ball) {
    Items items;
    for (std::uint32_t i = 0; i < count; ++i)
        items.push_back({ball(i), i});
    return items;
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
    return {{"one point, radii in progression",
             [=](std::uint32_t i) { return ball_at(0, 0, 0, std::exp2(20 * share(i))); }},
            {"equal", [](std::uint32_t) { return ball_at(1, 2, 3, 4); }},
            {"progression", [=](std::uint32_t i) { return ball_at(std::exp2(120 * share(i) - 90), 0, 0, 1e-30F); }},
            {"progression in space",
             [=](std::uint32_t i) { return ball_at(along(i, 0), along(i, 1), along(i, 2), spread(i) * 0.1F); }},
            {"progression of points, each many times",
             [](std::uint32_t i) { return ball_at(std::exp2(static_cast<float>(i % 60)), 0, 0, 1.0F); }},
            {"line", [=](std::uint32_t i) { return ball_at(share(i), 0, 0, 1e-6F); }},
            {"one huge",
             [=](std::uint32_t i) { return ball_at(share(i * 7919 % many), share(i), 0, i == 5 ? 1e9F : 1e-3F); }},
            {"all but one at one point",
             [=](std::uint32_t i) { return ball_at(i == many / 3 ? 5.0F : 1.0F, 2, 3, 1 + share(i)); }},
            {"two heaps", [=](std::uint32_t i) { return ball_at((i % 2 == 0 ? 1e9F : 0) + share(i), 0, 0, 1); }}};
}

// The depth of a tree must fit into the kernel's stack for any input.
TEST(SphereOrder, GivesEachSphereOnePlaceInATreeThatTheStackHolds) {
    for (const Kind &kind : kinds())
        for (const std::uint32_t count : {1U, 2U, 4U, 5U, 17U, 1000U, many}) {
            SCOPED_TRACE(std::string(kind.name) + ", " + std::to_string(count));
            pt::WorkProgress nobody;
            const auto own_number = [](std::uint32_t sphere) { return pt::SphereBits{sphere}; };
            pt::TreeShape shape = pt::tree_shape(items_of(count, kind.ball), own_number, nobody);
            expect_well_linked(shape);
            ASSERT_EQ(shape.spheres.size(), count);
            std::ranges::sort(shape.spheres);
            for (std::uint32_t i = 0; i < count; ++i)
                ASSERT_EQ(shape.spheres[i], i);
        }
}

// Coordinates below 4 are rounded by 2^-23, and sides of boxes by 2^-22. Half the surface has the error 2^-21 * (sum of
// the sides) < 2^-21 * 15.
constexpr double surface_error = 15 * 0x1p-21;

pt::Part part_of(Items &items) {
    return {items, pt::centers_of(items), 0.0F};
}

double surface_of(std::span<const pt::TreeItem> items) {
    std::array<double, 3> sides{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const pt::TreeItem &item : items) {
            low = std::min(low, double{item.center_radius[axis]} - item.center_radius[3]);
            high = std::max(high, double{item.center_radius[axis]} + item.center_radius[3]);
        }
        sides[axis] = high - low;
    }
    return sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0];
}

double cost_of(std::span<const pt::TreeItem> first, std::span<const pt::TreeItem> second) {
    const auto nodes = [](std::size_t count) { return std::ceil(static_cast<double>(count) / 4.0); };
    return surface_of(first) * nodes(first.size()) + surface_of(second) * nodes(second.size());
}

double least_cost(Items items, std::size_t first_axis = 0, std::size_t last_axis = 2) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t axis = first_axis; axis <= last_axis; ++axis) {
        const auto coordinate = [axis](const pt::TreeItem &item) { return item.center_radius[axis]; };
        std::ranges::sort(items, {}, coordinate);
        for (std::size_t count = 1; count < items.size(); ++count)
            if (coordinate(items[count - 1]) < coordinate(items[count]))
                least = std::min(least, cost_of(std::span(items).first(count), std::span(items).subspan(count)));
    }
    return least;
}

void expect_boxes(const pt::Part &part) {
    EXPECT_NEAR(part.surface, surface_of(part.items), surface_error);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] =
            std::ranges::minmax(part.items, {}, [axis](const pt::TreeItem &item) { return item.center_radius[axis]; });
        EXPECT_EQ(part.centers.low[axis], low.center_radius[axis]);
        EXPECT_EQ(part.centers.high[axis], high.center_radius[axis]);
    }
}

TEST(TreeCuts, OfFewSpheresAreTheBest) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    for (int round = 0; round < 3000; ++round) {
        const auto count = static_cast<std::uint32_t>(2 + round % (pt::most_swept - 1));
        const bool on_whole = round % 3 == 0;
        const auto coordinate = [&](float extent) {
            return on_whole ? std::floor(3.0F * share(engine)) : extent * share(engine) - 1.0F;
        };
        const Items before = items_of(count, [&](std::uint32_t) {
            return std::array{coordinate(2), coordinate(5), coordinate(3), 0.5F * share(engine) * share(engine)};
        });
        Items items = before;
        const pt::Part part = part_of(items);
        if (part.centers.is_point())
            continue;
        const pt::PartHalves halves = pt::swept_halves(part);
        expect_boxes(halves.first);
        expect_boxes(halves.second);
        // The chosen cut and the best one have at most four nodes each.
        const double most_error = 2 * 4 * surface_error;
        const double least = least_cost(before);
        EXPECT_NEAR(cost_of(halves.first.items, halves.second.items), least, most_error) << round;
        const bool is_between = std::ranges::any_of(std::array{0U, 1U, 2U}, [&](unsigned axis) {
            return halves.first.centers.high[axis] < halves.second.centers.low[axis];
        });
        EXPECT_TRUE(is_between) << "equal centers in both";
    }
}

// Some cut lies within half a bin of x = 1/2, and bins are 1/8 wide. Costs are proportional to x^2 + (1 - x)^2, so this
// cut costs at most 1/60 more than the best one. Random positions add to this.
TEST(TreeCuts, OfManySpheresAreAboutTheBest) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    for (const std::uint32_t count : {64U, 65U, 3000U})
        for (std::size_t longest = 0; longest < 3; ++longest) {
            const Items before = items_of(count, [&](std::uint32_t) {
                std::array ball{share(engine), share(engine), share(engine), 0.01F};
                ball[longest] *= 5.0F;
                return ball;
            });
            Items items = before;
            const pt::PartHalves halves = pt::binned_halves(part_of(items));
            expect_boxes(halves.first);
            expect_boxes(halves.second);
            EXPECT_LT(halves.first.centers.high[longest], halves.second.centers.low[longest]);
            EXPECT_LT(cost_of(halves.first.items, halves.second.items), 1.1 * least_cost(before, longest, longest));
        }
}

} // namespace

} // namespace sphere_orders
