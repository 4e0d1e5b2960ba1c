// Divides spheres, top down; see sphere_order.h.
#include "lib/tree/sphere_order.h"

#include "lib/tree/cuts.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

namespace pt {

namespace {

// Nodes from this depth on are halved: another log4(2^26) = 13 levels hold all spheres of a scene.
constexpr std::uint32_t free_depth = 14;

Part part_of(Items items) {
    return {items, centres_of(items), balls_of(items).surface()};
}

Halves halved(const Part &part) {
    const std::size_t axis = part.centres.longest_axis();
    const auto order = [axis](const TreeItem &item) { return std::tuple(item.centre_radius[axis], item.sphere); };
    const std::size_t half = part.items.size() / 2;
    std::ranges::nth_element(part.items, part.items.begin() + static_cast<std::ptrdiff_t>(half), {}, order);
    return {part_of(part.items.first(half)), part_of(part.items.subspan(half))};
}

Halves divided(const Part &part, std::uint32_t depth) {
    if (depth >= free_depth || part.centres.is_point())
        return halved(part);
    return part.items.size() <= most_swept ? swept_halves(part) : binned_halves(part);
}

// Input that all steps share.
struct Making {
    const SphereOrder &order;
    WorkProgress &progress;
};

// Whether any two of a few spheres may be twins.
bool have_equals(Items items) {
    for (std::size_t i = 0; i < items.size(); ++i)
        for (std::size_t other = 0; other < i; ++other)
            if (items[i].centre_radius == items[other].centre_radius)
                return true;
    return false;
}

Part without_twins(Part part, const Making &making) {
    const std::size_t count = part.items.size();
    if (count <= tree_width && !have_equals(part.items))
        return part;
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
    // Not std::ranges, whose result Clang 14 cannot compile.
    const auto twins = std::unique(part.items.begin(), part.items.end(), are_twins);
    part.items = part.items.first(static_cast<std::size_t>(twins - part.items.begin()));
    making.progress.add(static_cast<double>(count - part.items.size()), 0);
    return part;
}

struct Children {
    std::array<Part, tree_width> parts;
    std::size_t count = 0;

    void add(const Part &part) { parts[count++] = part; }
    std::span<Part> all() { return std::span(parts).first(count); }
};

// Whether a part is divided before another: the one with the larger surface or, deep in the tree, with more spheres, so
// that no child has more than a quarter of them.
bool goes_before(const Part &part, const Part &other, std::uint32_t depth) {
    return depth < free_depth ? part.surface > other.surface : part.items.size() > other.items.size();
}

// NULL if none can be divided.
Part *next_of(std::span<Part> parts, std::uint32_t depth) {
    Part *next = nullptr;
    for (Part &part : parts)
        if (part.items.size() > 1 && (next == nullptr || goes_before(part, *next, depth)))
            next = &part;
    return next;
}

// Divides a node's parts until there are enough children. Twins have equal centers, so cuts separate them only among
// few spheres or at one point; halving could, so twins are removed before it.
Children children_of(Part node, const Making &making, std::uint32_t depth) {
    Children children;
    if (node.items.size() <= tree_width || node.centres.is_point() || depth == free_depth)
        node = without_twins(node, making);
    if (node.items.size() <= tree_width) {
        for (std::size_t i = 0; i < node.items.size(); ++i)
            children.add({node.items.subspan(i, 1), {}});
        return children;
    }
    children.add(node);
    while (children.count < tree_width) {
        Part *const next = next_of(children.all(), depth);
        if (next == nullptr)
            break;
        auto [first, second] = divided(*next, depth);
        making.progress.add(0.0, next->items.size());
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
    shape.nodes.reserve(items.size() / 2); // nearly always enough
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
            progress.add(1.0, 0);
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
