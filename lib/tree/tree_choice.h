#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/sphere_source.h"
#include "lib/tree/sphere_extent.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace pt {

// A tree is faster from this many spheres on: DevicePolicy::unrolled + 1, because lavapipe does not unroll longer
// loops.
inline constexpr std::uint32_t default_tree_from = 113;

// The same limit if there are capsules, whose tests take several times as long. lavapipe takes seconds to compile these
// tests.
inline constexpr std::uint32_t tree_of_others_from = 24;

// Returns the least number of visible spheres that gets a tree.
constexpr std::uint32_t tree_from(const SphereCounts &counts, std::optional<std::uint32_t> wanted = {}) {
    const std::uint32_t pays = counts.capsules == 0 ? default_tree_from : tree_of_others_from;
    return counts.has_opacities ? 1 : wanted.value_or(pays);
}

struct TreeChoice {
    // Hidden spheres, distant ones and, if there are few, capsules. Indices are ascending.
    std::vector<std::uint32_t> left_out{};
    std::size_t hidden_count = 0;
    // The extent of tree spheres. `moves` includes other spheres, because kernels read all motions or none.
    SphereExtent extent{};
    std::vector<bool> used_materials{};
};

// Reads all spheres once. Each sphere is a unit of work.
TreeChoice tree_choice(const SphereSource &spheres, std::span<const Material> materials, WorkProgress &progress);

// Calls use(index, sphere) for all spheres except left_out, in ascending order.
template <typename Use>
void for_each_in_tree(const SphereSource &spheres, std::span<const std::uint32_t> left_out, WorkProgress &progress,
                      Use use) {
    spheres.for_each(progress, [&](std::uint32_t index, const Sphere &sphere) {
        if (!left_out.empty() && left_out.front() == index)
            left_out = left_out.subspan(1);
        else
            use(index, sphere);
    });
}

} // namespace pt
