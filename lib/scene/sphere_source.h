// The spheres of pt_set_scene, in the caller's memory.
#pragma once

#include "lib/base/work_progress.h"
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

// Valid only during pt_set_scene.
class SphereSource {
public:
    // Structs come first, then arrays. All must obey sphere_array_rules.h.
    SphereSource(std::span<const pt_sphere> spheres, std::span<const pt_sphere_array> arrays);

    std::size_t size() const { return starts_.back(); }

    // Whether any array that is not empty has the column.
    bool has(pt_column pt_sphere_array::*column) const;

    bool has_opacities() const { return has_opacities_; }

    std::uint64_t capsule_count() const { return capsule_count_; }

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
    bool has_opacities_;
    std::uint64_t capsule_count_ = 0;
};

} // namespace pt
