#pragma once

#include "lib/scene/srgb.h"

#include <pt/pt.h>

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace pt {

inline bool is_there(const pt_column &column) {
    return column.data != nullptr;
}

template <typename Element>
Element element(const pt_column &column, std::size_t index) {
    static_assert(std::is_trivially_copyable_v<Element>);
    Element value;
    std::memcpy(&value, static_cast<const std::byte *>(column.data) + index * column.stride_bytes, sizeof value);
    return value;
}

static_assert(sizeof(glm::vec3) == 3 * sizeof(float) && sizeof(glm::dvec3) == 3 * sizeof(double));

// Calls use(read). read(index) is a float or double.
template <typename Use>
decltype(auto) with_numbers(const pt_column &column, Use use) {
    if (column.type == PT_TYPE_FLOAT32)
        return use([&column](std::size_t index) { return element<float>(column, index); });
    return use([&column](std::size_t index) { return element<double>(column, index); });
}

template <typename Use>
decltype(auto) with_vectors(const pt_column &column, Use use) {
    if (column.type == PT_TYPE_FLOAT32)
        return use([&column](std::size_t index) { return element<glm::vec3>(column, index); });
    return use([&column](std::size_t index) { return element<glm::dvec3>(column, index); });
}

template <typename Use>
decltype(auto) with_colors(const pt_column &column, Use use) {
    if (column.type != PT_TYPE_SRGB8)
        return with_vectors(column, use);
    return use([&column](std::size_t index) {
        const auto bytes = element<glm::u8vec3>(column, index);
        return glm::vec3(linear_from_srgb(bytes.r), linear_from_srgb(bytes.g), linear_from_srgb(bytes.b));
    });
}

} // namespace pt
