// Sorts along all axes and tries every cut; see swept_cut.h. For so few spheres mispredicted branches would take most
// of the time, so there are next to none: the axes are lanes of one register.
#include "lib/tree/swept_cut.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace pt {

namespace {

using Counts = std::int32_t __attribute__((vector_size(16)));

constexpr std::size_t axes = 3;

// Along each axis, the spheres in ascending order of their centres; equal ones keep their order in the part.
struct Orders {
    std::array<std::array<std::uint8_t, most_swept>, axes> spheres; // indices in the part
    std::array<Vector, most_swept> coordinates;                     // in lanes by axis

    // The place of each sphere is the number of spheres before it, counted pair by pair.
    explicit Orders(Items items) {
        std::array<Vector, most_swept> centres;
        std::array<Counts, most_swept> places;
        for (std::size_t i = 0; i < items.size(); ++i) {
            centres[i] = std::bit_cast<Vector>(items[i].centre_radius);
            places[i] = Counts{};
            for (std::size_t other = 0; other < i; ++other) {
                const Counts is_before = centres[other] <= centres[i]; // -1 where it is
                places[i] -= is_before;
                places[other] += is_before + 1;
            }
        }
        for (std::size_t i = 0; i < items.size(); ++i)
            for (std::size_t axis = 0; axis < axes; ++axis) {
                const auto place = static_cast<std::size_t>(places[i][axis]);
                spheres[axis][place] = static_cast<std::uint8_t>(i);
                coordinates[place][axis] = centres[i][axis];
            }
    }
};

// One box for each axis.
struct Boxes {
    std::array<Box, axes> boxes;

    void add(std::span<const Box> balls, const Orders &orders, std::size_t place) {
        for (std::size_t axis = 0; axis < axes; ++axis)
            boxes[axis].add(balls[orders.spheres[axis][place]]);
    }

    Vector surfaces() const {
        std::array<Vector, axes> sides;
        for (std::size_t axis = 0; axis < axes; ++axis)
            sides[axis] = boxes[axis].high - boxes[axis].low;
        const auto along = [&](std::size_t axis) {
            return Vector{sides[0][axis], sides[1][axis], sides[2][axis], 0.0F};
        };
        const Vector x = along(0);
        const Vector y = along(1);
        const Vector z = along(2);
        return x * y + y * z + z * x;
    }
};

// The best cut along each axis: how many spheres of that order come before it.
struct Cuts {
    Vector costs{Box::none, Box::none, Box::none, Box::none};
    Counts counts{};
    Vector first_surfaces{};
    Vector second_surfaces{};

    std::size_t best_axis() const {
        const std::size_t axis = costs[1] < costs[0] ? 1 : 0;
        return costs[2] < costs[axis] ? 2 : axis;
    }
};

Cuts best_cuts(std::span<const Box> balls, const Orders &orders) {
    const std::size_t count = balls.size();
    std::array<Vector, most_swept> surfaces_from; // of a ball and those after it
    Boxes after;
    for (std::size_t i = count - 1; i > 0; --i) {
        after.add(balls, orders, i);
        surfaces_from[i] = after.surfaces();
    }
    Cuts best;
    Boxes before;
    for (std::size_t i = 1; i < count; ++i) {
        before.add(balls, orders, i - 1);
        const Vector first = before.surfaces();
        const Vector costs = first * nodes_for(i) + surfaces_from[i] * nodes_for(count - i);
        const Counts is_better = (costs < best.costs) & (orders.coordinates[i - 1] < orders.coordinates[i]);
        best.costs = is_better ? costs : best.costs;
        best.counts = is_better ? Counts{} + static_cast<std::int32_t>(i) : best.counts;
        best.first_surfaces = is_better ? first : best.first_surfaces;
        best.second_surfaces = is_better ? surfaces_from[i] : best.second_surfaces;
    }
    return best;
}

void put_in_order(Items items, const std::array<std::uint8_t, most_swept> &order) {
    std::array<TreeItem, most_swept> copies;
    std::ranges::copy(items, copies.begin());
    for (std::size_t i = 0; i < items.size(); ++i)
        items[i] = copies[order[i]];
}

} // namespace

Halves swept_halves(const Part &part) {
    std::array<Box, most_swept> balls;
    for (std::size_t i = 0; i < part.items.size(); ++i)
        balls[i] = ball_of(part.items[i]);
    const Orders orders(part.items);
    const Cuts cuts = best_cuts(std::span<const Box>(balls).first(part.items.size()), orders);
    const std::size_t axis = cuts.best_axis();
    put_in_order(part.items, orders.spheres[axis]);
    const Items first = part.items.first(static_cast<std::size_t>(cuts.counts[axis]));
    const Items second = part.items.subspan(first.size());
    return {{first, centres_of(first), cuts.first_surfaces[axis]},
            {second, centres_of(second), cuts.second_surfaces[axis]}};
}

} // namespace pt
