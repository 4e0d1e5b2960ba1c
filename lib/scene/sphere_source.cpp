#include "lib/scene/sphere_source.h"

#include "lib/scene/column.h"

#include <algorithm>
#include <cmath>

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

bool is_any_translucent(const pt_sphere_array &array) {
    const std::uint32_t rows = array.opacity.stride_bytes == 0 ? std::min(array.count, 1U) : array.count;
    bool any = false;
    if (is_there(array.opacity))
        with_numbers(array.opacity, [&](auto opacity) {
            for (std::uint32_t i = 0; i < rows && !any; ++i)
                any = opacity(i) < least_opaque;
        });
    return any;
}

template <typename At>
void read_columns(const pt_sphere_array &columns, At at, std::span<Sphere> spheres) {
    with_vectors(columns.center, [&](auto center) {
        for (std::size_t i = 0; i < spheres.size(); ++i)
            spheres[i].center = center(at(i));
    });
    with_numbers(columns.radius, [&](auto radius) {
        for (std::size_t i = 0; i < spheres.size(); ++i)
            spheres[i].radius = radius(at(i));
    });
    if (is_there(columns.motion))
        with_vectors(columns.motion, [&](auto motion) {
            for (std::size_t i = 0; i < spheres.size(); ++i)
                spheres[i].motion = motion(at(i));
        });
    else
        for (Sphere &sphere : spheres)
            sphere.motion = glm::dvec3(0.0);
    for (Sphere &sphere : spheres)
        sphere.kind = is_there(columns.end) ? Kind::capsule : Kind::ball;
    if (is_there(columns.end))
        with_vectors(columns.end, [&](auto end) {
            for (std::size_t i = 0; i < spheres.size(); ++i)
                spheres[i].motion = glm::dvec3(end(at(i))) - spheres[i].center;
        });
    if (is_there(columns.opacity))
        with_numbers(columns.opacity, [&](auto opacity) {
            for (std::size_t i = 0; i < spheres.size(); ++i)
                spheres[i].opacity = static_cast<std::int16_t>(std::lround(opacity(at(i)) * opaque));
        });
    else
        for (Sphere &sphere : spheres)
            sphere.opacity = no_opacity;
    if (is_there(columns.material))
        for (std::size_t i = 0; i < spheres.size(); ++i)
            spheres[i].material = element<std::uint32_t>(columns.material, at(i));
    else
        for (Sphere &sphere : spheres)
            sphere.material = 0;
}

template <typename At>
void read_color_column(const pt_column &column, At at, std::span<glm::vec3> colors) {
    if (is_there(column))
        with_colors(column, [&](auto color) {
            for (std::size_t i = 0; i < colors.size(); ++i)
                colors[i] = color(at(i));
        });
    else
        std::ranges::fill(colors, glm::vec3(1.0F));
}

} // namespace

SphereSource::SphereSource(std::span<const pt_sphere> spheres, std::span<const pt_sphere_array> arrays) {
    parts_.reserve(arrays.size() + 1);
    parts_.push_back(columns_of(spheres));
    parts_.insert(parts_.end(), arrays.begin(), arrays.end());
    starts_.reserve(parts_.size() + 1);
    starts_.push_back(0);
    for (const pt_sphere_array &part : parts_)
        starts_.push_back(starts_.back() + part.count);
    const auto any_has = [arrays](pt_column pt_sphere_array::*column) {
        return std::ranges::any_of(
            arrays, [column](const pt_sphere_array &array) { return array.count > 0 && is_there(array.*column); });
    };
    has_colors_ = any_has(&pt_sphere_array::color);
    has_opacities_ = std::ranges::any_of(arrays, is_any_translucent);
    static constexpr float whole = 1.0F;
    for (pt_sphere_array &part : parts_)
        if (!has_opacities_)
            part.opacity = {};
        else if (!is_there(part.opacity))
            part.opacity = {&whole, 0, PT_TYPE_FLOAT32};
    for (const pt_sphere_array &array : arrays)
        others_count_ += is_there(array.end) ? array.count : 0;
}

std::vector<std::uint32_t> SphereSource::other_kinds(std::size_t most) const {
    std::vector<std::uint32_t> indices;
    if (others_count_ > most)
        return indices;
    for (std::size_t part = 0; part < parts_.size(); ++part)
        if (is_there(parts_[part].end))
            for (std::uint32_t index = starts_[part]; index < starts_[part + 1]; ++index)
                indices.push_back(index);
    return indices;
}

Sphere SphereSource::operator[](std::uint32_t index) const {
    Sphere sphere;
    read({&index, 1}, {&sphere, 1});
    return sphere;
}

glm::vec3 SphereSource::color(std::uint32_t index) const {
    glm::vec3 color;
    read_colors({&index, 1}, {&color, 1});
    return color;
}

void SphereSource::mark_materials(std::vector<bool> &used, WorkProgress &progress) const {
    for (const pt_sphere_array &part : parts_) {
        const pt_column &column = part.material;
        const bool is_one_for_all = !is_there(column) || column.stride_bytes == 0;
        const std::uint32_t rows = is_one_for_all ? std::min(part.count, 1U) : part.count;
        for (std::uint32_t i = 0; i < rows; ++i) {
            used[is_there(column) ? element<std::uint32_t>(column, i) : 0] = true;
            progress.add(1);
        }
    }
}

void SphereSource::read(std::span<const std::uint32_t> indices, std::span<Sphere> spheres) const {
    read_parts(indices, spheres, [](const pt_sphere_array &columns, auto at, std::span<Sphere> of_part) {
        read_columns(columns, at, of_part);
    });
}

void SphereSource::read_colors(std::span<const std::uint32_t> indices, std::span<glm::vec3> colors) const {
    read_parts(indices, colors, [](const pt_sphere_array &columns, auto at, std::span<glm::vec3> of_part) {
        read_color_column(columns.color, at, of_part);
    });
}

// A sphere is in the last part that begins at or before its index.
template <typename Element, typename Read>
void SphereSource::read_parts(std::span<const std::uint32_t> indices, std::span<Element> elements,
                              Read read_part) const {
    while (!indices.empty()) {
        const auto after = std::ranges::upper_bound(starts_, indices.front());
        const pt_sphere_array &part = parts_[static_cast<std::size_t>(after - starts_.begin()) - 1];
        const std::uint32_t start = *(after - 1);
        const auto is_elsewhere = [=, size = part.count](std::uint32_t index) { return index - start >= size; };
        const auto count = static_cast<std::size_t>(std::ranges::find_if(indices, is_elsewhere) - indices.begin());
        read_part(
            part, [=](std::size_t i) { return std::size_t{indices[i] - start}; }, elements.first(count));
        indices = indices.subspan(count);
        elements = elements.subspan(count);
    }
}

} // namespace pt
