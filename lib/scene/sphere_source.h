// The spheres of pt_set_scene, in the caller's memory.
#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/column.h"
#include "lib/scene/scene.h"

#include <pt/pt.h>

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace pt {

struct SphereCounts {
    std::uint64_t spheres;
    std::uint64_t capsules = 0;
    bool has_opacities = false;
};

inline SphereCounts count_spheres(std::uint64_t struct_count, std::span<const pt_sphere_array> arrays) {
    SphereCounts counts{struct_count};
    for (const pt_sphere_array &array : arrays) {
        counts.spheres += array.count;
        counts.capsules += is_there(array.end) ? array.count : 0;
        const std::uint32_t rows = array.opacity.stride_bytes == 0 ? std::min(array.count, 1U) : array.count;
        if (is_there(array.opacity))
            with_real<1>(array.opacity, [&](auto opacity) {
                for (std::uint32_t i = 0; i < rows && !counts.has_opacities; ++i)
                    counts.has_opacities = opacity(i) < least_opaque;
            });
    }
    return counts;
}

// Valid only during pt_set_scene.
class SphereSource {
public:
    // Structs come first, then arrays. All must obey sphere_array_rules.h.
    SphereSource(std::span<const pt_sphere> spheres, std::span<const pt_sphere_array> arrays);

    std::size_t size() const { return starts_.back(); }

    // Whether any array that is not empty has the column.
    bool has(pt_column pt_sphere_array::*column) const;

    const SphereCounts &counts() const { return counts_; }

    // for_each() is faster for many spheres.
    Sphere operator[](std::uint32_t index) const;

    // Calls use(index, sphere) in order. Each sphere is a unit of work.
    template <typename Use>
    void for_each(WorkProgress &progress, Use use) const {
        std::array<std::uint32_t, chunk_size> indices;
        for_each_read(
            size(), progress,
            [&](std::size_t first, std::size_t count) {
                std::iota(indices.begin(), indices.end(), static_cast<std::uint32_t>(first));
                return std::span<const std::uint32_t>(indices).first(count);
            },
            use);
    }

    template <typename Use>
    void for_each(std::span<const std::uint32_t> indices, WorkProgress &progress, Use use) const {
        for_each_read(
            indices.size(), progress,
            [&](std::size_t first, std::size_t count) { return indices.subspan(first, count); }, use);
    }

    std::span<const std::uint32_t> array_starts() const { return {starts_.begin() + 1, starts_.end() - 1}; }

private:
    static constexpr std::size_t chunk_size = 256;

    template <typename From, typename Use>
    void for_each_read(std::size_t all, WorkProgress &progress, From from, Use use) const {
        std::array<Sphere, chunk_size> spheres;
        const pt_sphere_array *before = nullptr;
        for (std::size_t first = 0; first < all; first += chunk_size) {
            const std::size_t count = std::min(chunk_size, all - first);
            before = read(from(first, count), std::span(spheres).first(count), before);
            for (std::size_t i = 0; i < count; ++i)
                use(static_cast<std::uint32_t>(first + i), spheres[i]);
            progress.add(count);
        }
    }

    // Returns the array if all spheres are in one, otherwise NULL. `before` is the last result for the same `spheres`.
    // If the array is `before` again, only fields with columns change.
    const pt_sphere_array *read(std::span<const std::uint32_t> indices, std::span<Sphere> spheres,
                                const pt_sphere_array *before) const;

    std::vector<pt_sphere_array> parts_;
    std::vector<std::uint32_t> starts_;
    SphereCounts counts_;
};

} // namespace pt
