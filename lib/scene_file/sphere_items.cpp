#include "lib/scene_file/sphere_items.h"

#include "lib/base/struct_size.h"

#include <algorithm>
#include <type_traits>

namespace pt {
namespace {

template <typename Component>
constexpr std::uint32_t type_of = std::is_same_v<Component, double>  ? PT_TYPE_FLOAT64
                                  : std::is_same_v<Component, float> ? PT_TYPE_FLOAT32
                                                                     : PT_TYPE_UINT32;

bool is_of_struct(pt_column pt_sphere_array::*column) {
    return column == &pt_sphere_array::center || column == &pt_sphere_array::radius ||
           column == &pt_sphere_array::motion || column == &pt_sphere_array::material;
}

} // namespace

void SphereItems::note(pt_column pt_sphere_array::*column) {
    if (!has(column))
        columns_.push_back(column);
}

bool SphereItems::has(pt_column pt_sphere_array::*column) const {
    return std::ranges::find(columns_, column) != columns_.end();
}

std::vector<pt_sphere> SphereItems::structs() const {
    std::vector<pt_sphere> spheres;
    if (!std::ranges::all_of(columns_, is_of_struct))
        return spheres;
    spheres.reserve(items.size());
    for (const SphereItem &item : items) {
        const auto &[x, y, z] = item.center;
        const auto &[dx, dy, dz] = item.motion;
        spheres.push_back({{x, y, z}, item.radius[0], {dx, dy, dz}, item.material[0], 0});
    }
    return spheres;
}

pt_sphere_array SphereItems::array() const {
    auto array = sized<pt_sphere_array>();
    array.count = static_cast<std::uint32_t>(items.size());
#define PT_COLUMN(name, component, components, types, rule, is_needed, initial, set)                                   \
    if (has(&pt_sphere_array::name))                                                                                   \
        array.name = {items[0].name.data(), sizeof(SphereItem), type_of<component>};
    PT_SPHERE_COLUMNS(PT_COLUMN)
#undef PT_COLUMN
    return array;
}

} // namespace pt
