#include "lib/tree/cuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace tree_cuts {

namespace {

using Items = std::vector<pt::TreeItem>;

// Coordinates below 4 are rounded by 2^-23, and sides of boxes by 2^-22. Half the surface has the error 2^-21 * (sum of
// the sides) < 2^-21 * 15.
constexpr double surface_error = 15 * 0x1p-21;

pt::Part part_of(Items &items) {
    return {items, pt::centers_of(items), 0.0F};
}

Items items_of(std::uint32_t count, const std::function<std::array<float, 4>(std::uint32_t)> &ball) {
    Items items;
    for (std::uint32_t i = 0; i < count; ++i)
        items.push_back({ball(i), i});
    return items;
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
        const pt::Halves halves = pt::swept_halves(part);
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
            const pt::Halves halves = pt::binned_halves(part_of(items));
            expect_boxes(halves.first);
            expect_boxes(halves.second);
            EXPECT_LT(halves.first.centers.high[longest], halves.second.centers.low[longest]);
            EXPECT_LT(cost_of(halves.first.items, halves.second.items), 1.1 * least_cost(before, longest, longest));
        }
}

TEST(TreeCuts, OfSamplesHeedNoPattern) {
    const std::uint32_t count = 4 * pt::sampled_from;
    const std::uint32_t run = count / pt::sample_size;
    for (const std::uint32_t heap_at : {0U, run / 2, run - 1}) {
        const auto is_right = [=](std::uint32_t i) { return i % run == heap_at; };
        const Items before = items_of(count, [&](std::uint32_t i) {
            const float along = static_cast<float>(i) / static_cast<float>(count);
            return std::array{along + (is_right(i) ? 9.0F : 0.0F), 0.0F, 0.0F, 1e-3F};
        });
        Items items = before;
        const pt::Halves halves = pt::binned_halves(part_of(items));
        EXPECT_TRUE(
            std::ranges::none_of(halves.first.items, [&](const pt::TreeItem &item) { return is_right(item.sphere); }));
        EXPECT_TRUE(
            std::ranges::all_of(halves.second.items, [&](const pt::TreeItem &item) { return is_right(item.sphere); }));
    }
}

} // namespace

} // namespace tree_cuts
