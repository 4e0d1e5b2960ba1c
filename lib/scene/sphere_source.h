// The spheres that pt_set_scene was given, structs and columns alike, read where the caller has them.
#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/scene.h"

#include <pt/pt.h>

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// Refers to the caller's memory, and so is valid during the call that was given it. Several threads may read.
class SphereSource {
public:
    // In this order, which is the scene's. What is in them obeys the rules (sphere_array_rules.h).
    SphereSource(std::span<const pt_sphere> spheres, std::span<const pt_sphere_array> arrays);

    std::size_t size() const { return starts_.back(); }

    // Whether spheres may have a color of their own: else all colors are 1.
    bool has_colors() const { return has_colors_; }

    // One sphere, and by what its material's diffuse is multiplied. For many the functions below are faster.
    Sphere operator[](std::size_t index) const;
    glm::vec3 color(std::size_t index) const;

    // As many as there is room for, from the first on.
    void read(std::size_t first, std::span<Sphere> spheres) const;
    void read_colors(std::size_t first, std::span<glm::vec3> colors) const;

    // Those of the indices, as many: their memory, which may be anywhere, is waited for once for all.
    void read(std::span<const std::uint32_t> indices, std::span<Sphere> spheres) const;
    void read_colors(std::span<const std::uint32_t> indices, std::span<glm::vec3> colors) const;

    // Marks the materials that spheres have. Each sphere is a unit of work, or all that have one material for all.
    void mark_materials(std::vector<bool> &used, WorkProgress &progress) const;

    // Calls use(index, sphere, color) for each, in order.
    template <typename Use>
    void for_each(Use use) const {
        WorkProgress nobody;
        for_each(nobody, use);
    }

    // The same; each is a unit of work.
    template <typename Use>
    void for_each(WorkProgress &progress, Use use) const {
        for_each_read(
            size(), progress, [](std::size_t first, std::size_t) { return first; }, use);
    }

    // The same for the spheres of some indices, in their order: use(i, sphere, color) for that of indices[i].
    template <typename Use>
    void for_each(std::span<const std::uint32_t> indices, WorkProgress &progress, Use use) const {
        for_each_read(
            indices.size(), progress,
            [&](std::size_t first, std::size_t count) { return indices.subspan(first, count); }, use);
    }

    // The index of the first sphere of each array, or where it would be.
    std::span<const std::uint32_t> array_starts() const { return {starts_.begin() + 1, starts_.end() - 1}; }

private:
    static constexpr std::size_t chunk_size = 256; // 19 KiB, which stay in the first cache

    // Some at a time, from the first of them to the last: from(first, count) says from where to read so many.
    template <typename From, typename Use>
    void for_each_read(std::size_t all, WorkProgress &progress, From from, Use use) const {
        std::array<Sphere, chunk_size> spheres;
        std::array<glm::vec3, chunk_size> colors;
        colors.fill(glm::vec3(1.0F));
        for (std::size_t first = 0; first < all; first += chunk_size) {
            const std::size_t count = std::min(chunk_size, all - first);
            read(from(first, count), std::span(spheres).first(count));
            if (has_colors_)
                read_colors(from(first, count), std::span(colors).first(count));
            for (std::size_t i = 0; i < count; ++i)
                use(first + i, spheres[i], colors[i]);
            progress.add(count);
        }
    }

    std::size_t part_of(std::size_t index) const;

    // Calls read_part(columns, at, elements) for those in a row that lie in one array: at(i) is where the i-th is in
    // it.
    template <typename Element, typename Read>
    void read_parts(std::size_t first, std::span<Element> elements, Read read_part) const;
    template <typename Element, typename Read>
    void read_parts(std::span<const std::uint32_t> indices, std::span<Element> elements, Read read_part) const;

    std::vector<pt_sphere_array> parts_; // the structs as columns, then the arrays
    std::vector<std::uint32_t> starts_;  // index of the first sphere of each part, and the number of all
    bool has_colors_;
};

} // namespace pt
