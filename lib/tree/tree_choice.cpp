#include "lib/tree/tree_choice.h"

#include "lib/tree/middle.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>

namespace pt {

namespace {

// Every ray tests the spheres outside the tree. These tests take less time than a walk, because even
// default_tree_from tests take no longer. Distant spheres in the tree would slow walks, because boxes are enlarged by
// 2^-19 of the tree's reach.
constexpr std::size_t most_outlying = 50;

// Nearer spheres enlarge the grid by at most this factor. The other spheres then keep 25 of the coordinates' 29 bits,
// more than float32's 24.
constexpr double much_farther = 16.0;

// Walks are faster in a tree without capsules. So a few capsules, such as the twelve edges of a cell, stay outside.
constexpr std::size_t few_others = 16;

// Finds a few spheres that reach much_farther times as far from the middle as all other spheres.
class Outlying {
public:
    explicit Outlying(const SphereSource &spheres) :
        few_(std::min(most_outlying, spheres.size() / 2)),
        middle_(middle_of(static_cast<std::uint32_t>(spheres.size()),
                          [&](std::uint32_t i) { return spheres[i].center; })) {}

    void add(std::uint32_t index, const Sphere &sphere) {
        const double length = glm::length(sphere.center - middle_) + glm::length(sphere.motion) + sphere.radius;
        const Reach reach(length, index);
        if (farthest_.size() > few_ && reach.first <= farthest_.back().first)
            return;
        farthest_.insert(std::ranges::upper_bound(farthest_, reach, std::greater()), reach);
        farthest_.resize(std::min(farthest_.size(), few_ + 1));
    }

    std::vector<std::uint32_t> found() const {
        std::vector<std::uint32_t> found;
        for (const auto &[reach, index] : farthest_)
            if (reach > much_farther * farthest_.back().first)
                found.push_back(index);
        std::ranges::sort(found);
        return found;
    }

private:
    using Reach = std::pair<double, std::uint32_t>;
    std::size_t few_;
    glm::dvec3 middle_;
    std::vector<Reach> farthest_;
};

} // namespace

// Camera rays do not check the materials of tree spheres, so hidden spheres stay outside. Translucent
// spheres stay in the tree, because only its walks handle opacities. Outlying spheres are known last, so the extents of
// their blocks are found again.
TreeChoice tree_choice(const SphereSource &spheres, std::span<const Material> materials, WorkProgress &progress) {
    constexpr double share_of_choice = 0.12;
    constexpr std::uint32_t block_size = 256;
    progress.enter(share_of_choice, static_cast<double>(spheres.size()));
    TreeChoice choice{.used_materials = std::vector<bool>(materials.size())};
    Outlying outlying(spheres);
    const bool few_capsules = spheres.counts().capsules <= few_others;
    std::vector<SphereExtent> extents(spheres.size() / block_size + 1);
    spheres.for_each(progress, [&](std::uint32_t i, const Sphere &sphere) {
        const Material &material = materials[sphere.material];
        const bool is_beside = few_capsules && sphere.kind != Kind::ball && !sphere.is_translucent();
        choice.used_materials[sphere.material] = true;
        choice.hidden_count += material.hidden ? 1 : 0;
        choice.extent.moves = choice.extent.moves || sphere.ball().moves();
        outlying.add(i, sphere);
        if (material.hidden || is_beside)
            choice.left_out.push_back(i);
        else
            extents[i / block_size].add(sphere, emits(material));
    });
    std::vector<std::uint32_t> distant = outlying.found();
    std::erase_if(distant, [&](std::uint32_t i) { return spheres[i].is_translucent(); });
    std::vector<std::uint32_t> left_out;
    std::ranges::set_union(choice.left_out, distant, std::back_inserter(left_out));
    choice.left_out = std::move(left_out);
    for (const std::uint32_t each : distant) {
        const std::uint32_t first = each - each % block_size;
        SphereExtent &extent = extents[each / block_size] = {};
        for (std::uint32_t i = first; i < std::min<std::size_t>(first + block_size, spheres.size()); ++i)
            if (!std::ranges::binary_search(choice.left_out, i))
                extent.add(spheres[i], emits(materials[spheres[i].material]));
    }
    for (const SphereExtent &extent : extents)
        choice.extent.add(extent);
    return choice;
}

} // namespace pt
