#include "lib/scene/sphere_source.h"

#include "lib/scene/sphere_columns.h"

#include <algorithm>

namespace pt {

namespace {

pt_column column_of(const void *first, std::uint32_t type) {
    return {first, sizeof(pt_sphere), type};
}

pt_sphere_array columns_of(std::span<const pt_sphere> spheres) {
    pt_sphere_array columns{};
    columns.struct_size = sizeof columns;
    columns.count = static_cast<std::uint32_t>(spheres.size());
    if (spheres.empty())
        return columns;
    const pt_sphere &first = spheres.front();
    columns.center = column_of(first.center, PT_TYPE_FLOAT64);
    columns.radius = column_of(&first.radius, PT_TYPE_FLOAT64);
    columns.motion = column_of(first.motion, PT_TYPE_FLOAT64);
    columns.material = column_of(&first.material, PT_TYPE_UINT32);
    return columns;
}

// at(i) is the row of sphere i. Fields without a column do not change.
template <typename At>
void read_columns(const pt_sphere_array &columns, At at, std::span<Sphere> spheres) {
#define PT_READ(name, component, components, types, rule, is_needed, initial, set)                                     \
    if (is_there(columns.name))                                                                                        \
        with_##types<components>(columns.name, [&](auto read) {                                                        \
            const auto put = [](Sphere &sphere, const auto &value) { set; };                                           \
            for (std::size_t i = 0; i < spheres.size(); ++i)                                                           \
                put(spheres[i], read(at(i)));                                                                          \
        });
    PT_SPHERE_COLUMNS(PT_READ)
#undef PT_READ
}

} // namespace

SphereSource::SphereSource(std::span<const pt_sphere> spheres, std::span<const pt_sphere_array> arrays) :
    counts_(count_spheres(spheres.size(), arrays)) {
    parts_.reserve(arrays.size() + 1);
    parts_.push_back(columns_of(spheres));
    parts_.insert(parts_.end(), arrays.begin(), arrays.end());
    starts_.reserve(parts_.size() + 1);
    starts_.push_back(0);
    for (const pt_sphere_array &part : parts_)
        starts_.push_back(starts_.back() + part.count);
    static constexpr float whole = 1.0F;
    for (pt_sphere_array &part : parts_)
        if (!counts_.has_opacities)
            part.opacity = {};
        else if (!is_there(part.opacity))
            part.opacity = {&whole, 0, PT_TYPE_FLOAT32};
}

bool SphereSource::has(pt_column pt_sphere_array::*column) const {
    return std::ranges::any_of(
        parts_, [column](const pt_sphere_array &part) { return part.count > 0 && is_there(part.*column); });
}

Sphere SphereSource::operator[](std::uint32_t index) const {
    Sphere sphere;
    read({&index, 1}, {&sphere, 1}, nullptr);
    return sphere;
}

// A sphere is in the last part that begins at or before its index.
const pt_sphere_array *SphereSource::read(std::span<const std::uint32_t> indices, std::span<Sphere> spheres,
                                          const pt_sphere_array *before) const {
    const std::size_t all = indices.size();
    while (!indices.empty()) {
        const auto after = std::ranges::upper_bound(starts_, indices.front());
        const pt_sphere_array &part = parts_[static_cast<std::size_t>(after - starts_.begin()) - 1];
        const std::uint32_t start = *(after - 1);
        const auto is_elsewhere = [=, size = part.count](std::uint32_t index) { return index - start >= size; };
        const auto count = static_cast<std::size_t>(std::ranges::find_if(indices, is_elsewhere) - indices.begin());
        if (&part != before)
            std::ranges::fill(spheres.first(count), Sphere{});
        before = count == all ? &part : nullptr;
        read_columns(
            part, [=](std::size_t i) { return std::size_t{indices[i] - start}; }, spheres.first(count));
        indices = indices.subspan(count);
        spheres = spheres.subspan(count);
    }
    return before;
}

} // namespace pt
