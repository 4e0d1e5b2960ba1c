// Goes through all spheres; see sphere_extent.h.
#include "lib/tree/sphere_extent.h"

#include <algorithm>

namespace pt {

namespace {

constexpr double share_of_extent = 0.06; // of what is left of the work, as measured with a million spheres

} // namespace

SphereExtent::SphereExtent(const SphereSource &spheres, std::span<const std::uint32_t> left_out,
                           std::span<const TreeMaterial> materials, WorkProgress &progress) {
    progress.enter(share_of_extent, static_cast<double>(spheres.size()));
    for_each_in_tree(spheres, left_out, progress, [&](std::uint32_t, const Sphere &sphere) {
        const glm::dvec3 end = sphere.center + sphere.motion;
        low = glm::min(low, glm::min(sphere.center, end) - sphere.radius);
        high = glm::max(high, glm::max(sphere.center, end) + sphere.radius);
        largest_radius = std::max(largest_radius, sphere.radius);
        moves = moves || sphere.moves();
        has_capsules = has_capsules || sphere.swept;
        lamp_count += materials[sphere.material].emits ? 1 : 0;
    });
    for (const std::uint32_t index : left_out)
        moves = moves || spheres[index].moves();
}

// With one step more than needed on each side, because places are rounded: the box of tiny distant balls may consist of
// nothing but rounding.
Grid SphereExtent::grid() const {
    const glm::dvec3 half = 0.5 * high - 0.5 * low;
    return {0.5 * low + 0.5 * high, std::max({half.x, half.y, half.z, largest_radius}) * (1.0 + 0x1p-28)};
}

} // namespace pt
