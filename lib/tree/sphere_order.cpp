// Divides spheres, top down; see sphere_order.h.
#include "lib/tree/sphere_order.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

namespace pt {

namespace {

using Items = std::span<TreeItem>;
using Vector = float __attribute__((vector_size(16))); // three coordinates and one that is not used, in one register

// From here on nodes are halved: another log4(2^26) = 13 levels hold all the spheres that a scene may have.
constexpr std::uint32_t free_depth = 14;

// Of large parts the longest axis alone is looked at: the others are nearly never better there, and cost as much again.
constexpr std::size_t one_axis_from = 64;

constexpr int most_bins = 16;

// More bins for fewer spheres change nothing but the time.
int bins_for(std::size_t spheres) {
    return spheres > 64 ? most_bins : 8;
}

Vector vector_of(const TreeItem &item) {
    return std::bit_cast<Vector>(item.centre_radius);
}

struct Box {
    static constexpr float none = std::numeric_limits<float>::infinity();
    Vector low{none, none, none, none};
    Vector high{-none, -none, -none, -none};

    void add(const Vector &from, const Vector &to) {
        low = from < low ? from : low;
        high = to > high ? to : high;
    }

    void add(const Box &other) { add(other.low, other.high); }

    void add_centre(const TreeItem &item) {
        const Vector centre = vector_of(item);
        add(centre, centre);
    }

    void add_ball(const TreeItem &item) {
        const Vector centre = vector_of(item);
        add(centre - centre[3], centre + centre[3]);
    }

    float extent(std::size_t axis) const { return high[axis] - low[axis]; }
    bool is_point() const { return extent(0) == 0.0F && extent(1) == 0.0F && extent(2) == 0.0F; }

    // Half of it; of no box, what is not less than any number.
    float surface() const { return extent(0) * extent(1) + extent(1) * extent(2) + extent(2) * extent(0); }

    std::size_t longest_axis() const {
        const std::size_t axis = extent(1) > extent(0) ? 1 : 0;
        return extent(2) > extent(axis) ? 2 : axis;
    }
};

// Spheres that are still together, and the box of their centres.
struct Part {
    Items items;
    Box centres;
    float surface = 0.0F; // of the box about the spheres
};

Box centres_of(Items items) {
    Box box;
    for (const TreeItem &item : items)
        box.add_centre(item);
    return box;
}

Part part_of(Items items) {
    Box balls;
    for (const TreeItem &item : items)
        balls.add_ball(item);
    return {items, centres_of(items), balls.surface()};
}

// Divides centres along an axis into bins of equal width.
class Bins {
public:
    Bins(const Part &part, std::size_t axis) :
        axis_(axis),
        count_(bins_for(part.items.size())),
        low_(part.centres.low[axis]),
        scale_(static_cast<float>(count_) / part.centres.extent(axis)) {}

    int count() const { return count_; }

    int bin_of(const TreeItem &item) const {
        return std::min(static_cast<int>((item.centre_radius[axis_] - low_) * scale_), count_ - 1);
    }

private:
    std::size_t axis_;
    int count_;
    float low_;
    float scale_;
};

// Where to divide a part: before a bin of an axis.
struct Cut {
    float cost = std::numeric_limits<float>::infinity(); // none, then
    std::size_t axis = 0;
    int bin = 0;
    float first_surface = 0.0F;
    float second_surface = 0.0F;
};

// Nodes of the lowest level for so many spheres.
float nodes_for(std::size_t count) {
    return static_cast<float>((count + tree_width - 1) / tree_width);
}

// Looks for a better cut between the bins of an axis.
void improve(Cut &best, const Part &part, std::size_t axis) {
    const Bins bins(part, axis);
    std::array<Box, most_bins> boxes;
    std::array<std::size_t, most_bins> counts{};
    for (const TreeItem &item : part.items) {
        const auto bin = static_cast<std::size_t>(bins.bin_of(item));
        boxes[bin].add_ball(item);
        ++counts[bin];
    }
    std::array<float, most_bins> surfaces_from{}; // of the balls in a bin and those after it
    Box after;
    for (int bin = bins.count() - 1; bin > 0; --bin) {
        after.add(boxes[static_cast<std::size_t>(bin)]);
        surfaces_from[static_cast<std::size_t>(bin)] = after.surface();
    }
    Box before;
    std::size_t count = 0;
    for (int bin = 1; bin < bins.count(); ++bin) {
        const auto i = static_cast<std::size_t>(bin);
        before.add(boxes[i - 1]);
        count += counts[i - 1];
        if (count == 0 || count == part.items.size())
            continue;
        const float first = before.surface();
        const float cost = first * nodes_for(count) + surfaces_from[i] * nodes_for(part.items.size() - count);
        if (cost < best.cost)
            best = {cost, axis, bin, first, surfaces_from[i]};
    }
}

Cut best_cut(const Part &part) {
    Cut best;
    const std::size_t longest = part.centres.longest_axis();
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (part.centres.extent(axis) > 0.0F && (axis == longest || part.items.size() < one_axis_from))
            improve(best, part, axis);
    return best;
}

// Without branches, of which every other would be mispredicted.
std::pair<Part, Part> divided_at(const Part &part, const Cut &cut) {
    const Bins bins(part, cut.axis);
    std::size_t count = 0; // on the first side so far; up to the item that is looked at, the others are on the second
    for (TreeItem &item : part.items) {
        const TreeItem looked_at = item;
        item = part.items[count];
        part.items[count] = looked_at;
        count += bins.bin_of(looked_at) < cut.bin ? 1 : 0;
    }
    const Items first = part.items.first(count);
    const Items second = part.items.subspan(count);
    return {{first, centres_of(first), cut.first_surface}, {second, centres_of(second), cut.second_surface}};
}

std::pair<Part, Part> halved(const Part &part) {
    const std::size_t axis = part.centres.longest_axis();
    const auto order = [axis](const TreeItem &item) { return std::tuple(item.centre_radius[axis], item.sphere); };
    const std::size_t half = part.items.size() / 2;
    std::ranges::nth_element(part.items, part.items.begin() + static_cast<std::ptrdiff_t>(half), {}, order);
    return {part_of(part.items.first(half)), part_of(part.items.subspan(half))};
}

std::pair<Part, Part> divided(const Part &part, std::uint32_t depth) {
    if (depth < free_depth) {
        const Cut cut = best_cut(part);
        if (cut.bin > 0)
            return divided_at(part, cut);
    }
    return halved(part);
}

// How the tree is made, beside the spheres: what twins are, and who is told.
struct Making {
    const SphereOrder &order;
    WorkProgress &progress;
};

Part without_twins(Part part, const Making &making) {
    const std::size_t count = part.items.size();
    std::ranges::sort(part.items, [&](const TreeItem &a, const TreeItem &b) {
        making.progress.add(0.0, 1);
        if (a.centre_radius != b.centre_radius)
            return a.centre_radius < b.centre_radius;
        const std::strong_ordering order = making.order(a.sphere, b.sphere);
        return order < 0 || (order == 0 && a.sphere < b.sphere);
    });
    const auto are_twins = [&](const TreeItem &a, const TreeItem &b) {
        return a.centre_radius == b.centre_radius && making.order(a.sphere, b.sphere) == 0;
    };
    // Not of std::ranges: what that returns is more than Clang 14 can take.
    const auto twins = std::unique(part.items.begin(), part.items.end(), are_twins);
    part.items = part.items.first(static_cast<std::size_t>(twins - part.items.begin()));
    making.progress.add(shape_work(count) - shape_work(part.items.size()), 0);
    return part;
}

struct Children {
    std::array<Part, tree_width> parts;
    std::size_t count = 0;

    void add(const Part &part) { parts[count++] = part; }
    std::span<Part> all() { return std::span(parts).first(count); }
};

// Whether a part is to be divided before another: the one with the larger surface, and deep in the tree the one with more
// spheres, so that no child has more than a quarter of the node's.
bool goes_before(const Part &part, const Part &other, std::uint32_t depth) {
    return depth < free_depth ? part.surface > other.surface : part.items.size() > other.items.size();
}

// The part that is to be divided next, or NULL.
Part *next_of(std::span<Part> parts, std::uint32_t depth) {
    Part *next = nullptr;
    for (Part &part : parts)
        if (part.items.size() > 1 && (next == nullptr || goes_before(part, *next, depth)))
            next = &part;
    return next;
}

// The children of a node: of its parts one after the other is divided until there are enough. Twins have equal centres, so
// that no cut comes between them before all that is left is at one point, or few. Halving might, so they are looked for
// before it begins.
Children children_of(Part node, const Making &making, std::uint32_t depth) {
    Children children;
    if (node.items.size() <= tree_width || node.centres.is_point() || depth == free_depth)
        node = without_twins(node, making);
    if (node.items.size() <= tree_width) {
        const std::size_t count = node.items.size();
        for (std::size_t i = 0; i < count; ++i)
            children.add({node.items.subspan(i, 1), {}});
        making.progress.add(shape_work(count) - static_cast<double>(count) * shape_work(1), 0);
        return children;
    }
    children.add(node);
    while (children.count < tree_width) {
        Part *const next = next_of(children.all(), depth);
        if (next == nullptr)
            break;
        auto [first, second] = divided(*next, depth);
        making.progress.add(shape_work(next->items.size()) - shape_work(first.items.size()) -
                                shape_work(second.items.size()),
                            next->items.size());
        for (Part *const part : {&first, &second})
            if (part->items.size() > 1 && part->centres.is_point() && depth < free_depth)
                *part = without_twins(*part, making);
        *next = first;
        children.add(second);
    }
    return children;
}

} // namespace

TreeShape tree_shape(std::vector<TreeItem> items, const SphereOrder &order, WorkProgress &progress) {
    struct Task {
        Part part;
        std::uint32_t node;
        std::uint32_t depth;
    };
    TreeShape shape{{TreeLinks{}}, {}, 0};
    shape.spheres.reserve(items.size());
    std::vector<Task> tasks{{part_of(items), 0, 1}};
    while (!tasks.empty()) {
        const Task task = tasks.back();
        tasks.pop_back();
        shape.depth = std::max(shape.depth, task.depth);
        Children children = children_of(task.part, {order, progress}, task.depth);

        TreeLinks &links = shape.nodes[task.node];
        links.first_child = static_cast<std::uint32_t>(shape.nodes.size());
        links.first_place = static_cast<std::uint32_t>(shape.spheres.size());
        links.child_count = static_cast<std::uint8_t>(children.count);
        for (const Part &child : children.all()) {
            if (child.items.size() > 1)
                continue;
            shape.spheres.push_back(child.items.front().sphere);
            progress.add(shape_work(1), 0);
        }
        links.inner_count = static_cast<std::uint8_t>(children.count - (shape.spheres.size() - links.first_place));
        for (const Part &child : children.all()) {
            if (child.items.size() == 1)
                continue;
            tasks.push_back({child, static_cast<std::uint32_t>(shape.nodes.size()), task.depth + 1});
            shape.nodes.emplace_back();
        }
    }
    return shape;
}

} // namespace pt
