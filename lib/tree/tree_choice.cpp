#include "lib/tree/tree_choice.h"

#include "lib/tree/middle.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>

namespace pt {

namespace {

// Every ray tests the spheres outside the tree, which at most doubles the time (default_tree_from). Distant spheres in
// the tree would make it slower, because boxes are enlarged by 2^-19 of the tree's reach.
constexpr std::size_t most_outlying = 50;

// Nearer spheres enlarge the grid by at most this factor. The other spheres then keep 25 of the coordinates' 29 bits,
// more than float32's 24.
constexpr double much_farther = 16.0;

// Walks are faster in a tree without capsules. So a few capsules, such as the twelve edges of a cell, stay outside.
constexpr std::size_t few_others = 16;

std::vector<std::uint32_t> outlying_spheres(const SphereSource &spheres, WorkProgress &progress) {
    const std::size_t few = std::min(most_outlying, spheres.size() / 2);
    const glm::dvec3 middle =
        middle_of(static_cast<std::uint32_t>(spheres.size()), [&](std::uint32_t i) { return spheres[i].center; });

    using Reach = std::pair<double, std::uint32_t>;
    std::vector<Reach> farthest;
    spheres.for_each(progress, [&](std::size_t i, const Sphere &sphere, const glm::vec3 &) {
        const double length = glm::length(sphere.center - middle) + glm::length(sphere.motion) + sphere.radius;
        const Reach reach(length, static_cast<std::uint32_t>(i));
        if (farthest.size() > few && reach.first <= farthest.back().first)
            return;
        farthest.insert(std::ranges::upper_bound(farthest, reach, std::greater()), reach);
        farthest.resize(std::min(farthest.size(), few + 1));
    });

    std::vector<std::uint32_t> outlying;
    for (const auto &[reach, index] : farthest)
        if (reach > much_farther * farthest.back().first)
            outlying.push_back(index);
    std::ranges::sort(outlying);
    return outlying;
}

} // namespace

std::uint32_t tree_pays_from(const SphereSource &spheres) {
    return spheres.are_mere_balls() ? default_tree_from : tree_of_others_from;
}

// Translucent spheres stay in the tree, because only its walks handle opacities.
std::vector<std::uint32_t> spheres_beside_tree(const SphereSource &spheres, WorkProgress &progress) {
    const std::vector<std::uint32_t> outlying = outlying_spheres(spheres, progress);
    std::vector<std::uint32_t> beside;
    std::ranges::set_union(outlying, spheres.other_kinds(few_others), std::back_inserter(beside));
    if (spheres.has_opacities())
        std::erase_if(beside, [&](std::uint32_t i) { return spheres[i].opacity < opaque; });
    return beside;
}

} // namespace pt
