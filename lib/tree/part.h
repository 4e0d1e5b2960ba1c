#pragma once

#include "lib/base/mixed.h"
#include "lib/tree/sphere_order.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace pt {

using Vector = float __attribute__((vector_size(16)));
using Items = std::span<TreeItem>;

struct Box {
    static constexpr float none = std::numeric_limits<float>::infinity();
    Vector low{none, none, none, none};
    Vector high{-none, -none, -none, -none};

    void add(const Vector &from, const Vector &to) {
        low = from < low ? from : low;
        high = to > high ? to : high;
    }

    void add(const Box &other) { add(other.low, other.high); }

    void add_center(const TreeItem &item) {
        const auto center = std::bit_cast<Vector>(item.center_radius);
        add(center, center);
    }

    void add_ball(const TreeItem &item) {
        const auto center = std::bit_cast<Vector>(item.center_radius);
        add(center - center[3], center + center[3]);
    }

    float extent(std::size_t axis) const { return high[axis] - low[axis]; }
    bool is_point() const { return extent(0) == 0.0F && extent(1) == 0.0F && extent(2) == 0.0F; }

    float surface() const {
        const Vector sides = high - low;
        const Vector products = sides * __builtin_shufflevector(sides, sides, 1, 2, 0, 3);
        return products[0] + products[1] + products[2];
    }

    std::size_t longest_axis() const {
        const std::size_t axis = extent(1) > extent(0) ? 1 : 0;
        return extent(2) > extent(axis) ? 2 : axis;
    }
};

// Samples of this size give nearly as good cuts as all spheres.
inline constexpr std::size_t sample_size = 4096;

inline constexpr std::size_t sampled_from = 4 * sample_size;

// Calls use(item) for all items of a small group, or for one item of each of sample_size runs of a large group. The
// choice is pseudorandom, because items may be in a regular order.
template <typename Use>
void for_each_or_sample(Items items, Use use) {
    if (items.size() < sampled_from) {
        for (const TreeItem &item : items)
            use(item);
        return;
    }
    std::uint64_t random = 0;
    for (std::size_t run = 0; run < sample_size; ++run) {
        const std::size_t first = items.size() * run / sample_size;
        const std::size_t length = items.size() * (run + 1) / sample_size - first;
        random = mixed(random);
        use(items[first + random % length]);
    }
}

// Returns the box of all centers. Large groups have the box of a sample, unless all centers of the sample are equal.
inline Box centers_of(Items items) {
    Box box;
    for_each_or_sample(items, [&](const TreeItem &item) { box.add_center(item); });
    if (box.is_point())
        for (const TreeItem &item : items)
            box.add_center(item);
    return box;
}

inline Box balls_of(Items items) {
    Box box;
    for_each_or_sample(items, [&](const TreeItem &item) { box.add_ball(item); });
    return box;
}

// A group of spheres to be split. Large groups have the boxes of a sample.
struct Part {
    Items items;
    Box centers; // a single point only if all centers are equal
    float surface = 0.0F;
    bool has_no_twins = false;
};

struct PartHalves {
    Part first;
    Part second;
};

inline float nodes_for(std::size_t count) {
    const std::size_t nodes = (count + tree_width - 1) / tree_width;
    return static_cast<float>(nodes);
}

} // namespace pt
