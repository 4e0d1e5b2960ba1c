#pragma once

#include "lib/scene/sphere_columns.h"

#include <pt/pt.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pt {

template <typename Component, std::size_t count>
constexpr std::array<Component, count> filled(Component value) {
    std::array<Component, count> all{};
    all.fill(value);
    return all;
}

struct SphereItem {
#define PT_MEMBER(name, component, components, types, rule, is_needed, initial, set)                                   \
    std::array<component, components> name = filled<component, components>(initial);
    PT_SPHERE_COLUMNS(PT_MEMBER)
#undef PT_MEMBER
};

class SphereItems {
public:
    std::vector<SphereItem> items{};

    // Notes that an item has the column. All items have a material.
    void note(pt_column pt_sphere_array::*column);

    // Empty if an item has a column that pt_sphere lacks.
    std::vector<pt_sphere> structs() const;

    // The result points into `items`, which must not be empty.
    pt_sphere_array array() const;

private:
    bool has(pt_column pt_sphere_array::*column) const;

    std::vector<pt_column pt_sphere_array::*> columns_{&pt_sphere_array::material};
};

} // namespace pt
