#include "lib/tree/sphere_order.h"

#include "lib/base/mixed.h"
#include "lib/tree/cuts.h"

#include <algorithm>
#include <span>
#include <tuple>

namespace pt {

namespace {

// Nodes at this depth or deeper are halved. 13 = log4(2^26) more levels hold all spheres of a scene.
constexpr std::uint32_t free_depth = 14;

Part part_of(Items items) {
    return {items, centers_of(items), balls_of(items).surface()};
}

PartHalves halved(const Part &part) {
    const std::size_t axis = part.centers.longest_axis();
    const auto order = [axis](const TreeItem &item) { return std::tuple(item.center_radius[axis], item.sphere); };
    const std::size_t half = part.items.size() / 2;
    std::ranges::nth_element(part.items, part.items.begin() + static_cast<std::ptrdiff_t>(half), {}, order);
    PartHalves halves{part_of(part.items.first(half)), part_of(part.items.subspan(half))};
    halves.first.has_no_twins = halves.second.has_no_twins = part.has_no_twins;
    return halves;
}

PartHalves divided(const Part &part, std::uint32_t depth) {
    if (depth >= free_depth || part.centers.is_point())
        return halved(part);
    return part.items.size() <= most_swept ? swept_halves(part) : binned_halves(part);
}

struct Making {
    const BitsOfSphere &bits_of;
    WorkProgress &progress;
};

bool have_equals(Items items) {
    for (std::size_t i = 0; i < items.size(); ++i)
        for (std::size_t other = 0; other < i; ++other)
            if (items[i].center_radius == items[other].center_radius)
                return true;
    return false;
}

std::uint64_t hash_of(const SphereBits &bits) {
    std::uint64_t hash = 0;
    for (const std::uint32_t word : bits)
        hash = mixed(hash ^ word);
    return hash;
}

// Reading the bits of spheres is slow, so only spheres with equal hashes are compared.
Part without_twins(Part part, const Making &making) {
    const std::size_t count = part.items.size();
    if (part.has_no_twins || (count <= tree_width && !have_equals(part.items)))
        return part;
    struct Hashed {
        std::uint64_t hash;
        TreeItem item;
    };
    std::vector<Hashed> hashed;
    hashed.reserve(count);
    for (const TreeItem &item : part.items) {
        hashed.push_back({hash_of(making.bits_of(item.sphere)), item});
        making.progress.add(0.0, 1);
    }
    std::ranges::sort(hashed, [&](const Hashed &a, const Hashed &b) {
        making.progress.add(0.0, 1);
        return std::tie(a.hash, a.item.sphere) < std::tie(b.hash, b.item.sphere);
    });
    std::size_t kept = 0;
    for (const Hashed &each : hashed) {
        bool is_twin = false;
        for (std::size_t i = kept; !is_twin && i > 0 && hashed[i - 1].hash == each.hash; --i)
            is_twin = making.bits_of(hashed[i - 1].item.sphere) == making.bits_of(each.item.sphere);
        making.progress.add(0.0, 1);
        if (is_twin)
            continue;
        part.items[kept] = each.item;
        hashed[kept++] = each;
    }
    part.items = part.items.first(kept);
    part.has_no_twins = true;
    making.progress.add(static_cast<double>(count - kept), 0);
    return part;
}

struct Children {
    std::array<Part, tree_width> parts;
    std::size_t count = 0;

    void add(const Part &part) { parts[count++] = part; }
    std::span<Part> all() { return std::span(parts).first(count); }
};

// The part with the larger surface is divided first. Deep in the tree, the part with more spheres is divided first, so
// that no child has more than a quarter of the spheres.
bool goes_before(const Part &part, const Part &other, std::uint32_t depth) {
    return depth < free_depth ? part.surface > other.surface : part.items.size() > other.items.size();
}

Part *next_of(std::span<Part> parts, std::uint32_t depth) {
    Part *next = nullptr;
    for (Part &part : parts)
        if (part.items.size() > 1 && (next == nullptr || goes_before(part, *next, depth)))
            next = &part;
    return next;
}

// Divides a node's parts until there are enough children. Cuts of few spheres, of spheres with one common center, or
// into equal halves can separate twins, so twins are removed first.
Children children_of(Part node, const Making &making, std::uint32_t depth) {
    Children children;
    if (node.items.size() <= tree_width || node.centers.is_point() || depth == free_depth)
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
            if (part->items.size() > 1 && part->centers.is_point() && depth < free_depth)
                *part = without_twins(*part, making);
        *next = first;
        children.add(second);
    }
    return children;
}

} // namespace

TreeShape tree_shape(std::vector<TreeItem> items, const BitsOfSphere &bits_of, WorkProgress &progress) {
    struct Task {
        Part part;
        std::uint32_t node;
        std::uint32_t depth;
    };
    TreeShape shape{{TreeLinks{}}, {}, 0};
    shape.nodes.reserve(items.size() / 2);
    shape.spheres.reserve(items.size());
    std::vector<Task> tasks{{part_of(items), 0, 1}};
    while (!tasks.empty()) {
        const Task task = tasks.back();
        tasks.pop_back();
        shape.depth = std::max(shape.depth, task.depth);
        Children children = children_of(task.part, {bits_of, progress}, task.depth);

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
