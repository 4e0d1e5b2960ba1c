#include "lib/scene/sphere_array_rules.h"

#include "lib/base/struct_size.h"
#include "lib/scene/column.h"
#include "lib/scene/scene.h"
#include "lib/scene/sphere_columns.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>

namespace pt {

namespace {

// Detects an uninitialised count before arrays are read.
constexpr std::uint32_t max_array_count = 65536;

// Also detects negative strides of NumPy.
constexpr std::uint32_t max_stride = (std::uint32_t{1} << 31) - 1;

struct ElementType {
    bool (*is)(std::uint32_t type);
    const char *rule;
};

constexpr ElementType real_type{[](std::uint32_t type) { return type == PT_TYPE_FLOAT32 || type == PT_TYPE_FLOAT64; },
                                "must be PT_TYPE_FLOAT32 (1) or PT_TYPE_FLOAT64 (2)"};
constexpr ElementType index_type{[](std::uint32_t type) { return type == PT_TYPE_UINT32; },
                                 "must be PT_TYPE_UINT32 (3)"};
constexpr ElementType color_type{[](std::uint32_t type) { return real_type.is(type) || type == PT_TYPE_SRGB8; },
                                 "must be PT_TYPE_FLOAT32 (1), PT_TYPE_FLOAT64 (2) or PT_TYPE_SRGB8 (4)"};

// Lamps are sampled by the cone around a ball, so capsules must not emit.
const char *const dark_rule = "must be a material without emission, because capsules cannot be lamps";

bool is_dark(const pt_material &material) {
    return std::ranges::all_of(material.emission, [](float component) { return component == 0.0F; });
}

// Shadow rays do not test their lamp's opacity. Camera rays do not test whether a tree sphere is hidden.
const char *const plain_rule = "must be a material that neither emits nor is hidden, because the opacity is below 1";

bool is_plain(const pt_material &material) {
    return is_dark(material) && (material.flags & PT_MATERIAL_HIDDEN_FROM_CAMERA) == 0;
}

template <Rule rule, typename Value>
const char *broken(const Value &value) {
    if constexpr (std::is_floating_point_v<Value>)
        return rule(value);
    else {
        const char *x = rule(value.x);
        const char *y = rule(value.y);
        return x ? x : y ? y : rule(value.z);
    }
}

class ColumnChecker;

struct ColumnKind {
    const char *name;
    pt_column pt_sphere_array::*column;
    std::uint32_t components;
    ElementType type;
    bool is_needed;
    void (ColumnChecker::*check)(const ColumnKind &kind) const;
};

class ColumnChecker {
public:
    ColumnChecker(const Subject &subject, const pt_sphere_array &array, std::span<const pt_material> materials,
                  WorkProgress &progress) :
        subject_(subject),
        array_(array),
        materials_(materials),
        progress_(progress) {}

    template <Rule rule, typename Component, int components>
    void values(const ColumnKind &kind) const {
        const pt_column &column = array_.*kind.column;
        if constexpr (std::is_integral_v<Component>)
            materials();
        else if (column.type != PT_TYPE_SRGB8)
            with_real<components>(column, [&](auto read) {
                check(
                    kind.name, elements(column), read, [](const auto &value) { return !broken<rule>(value); },
                    [](const auto &value) { return broken<rule>(value); });
            });
        if (kind.column == &pt_sphere_array::end)
            ends();
        if (kind.column == &pt_sphere_array::opacity)
            opacities();
    }

    void materials() const {
        check_materials([&](std::uint32_t material) { return material < materials_.size(); },
                        material_rule(static_cast<std::uint32_t>(materials_.size())));
    }

private:
    void ends() const {
        check_materials(
            [&](std::uint32_t material) { return material >= materials_.size() || is_dark(materials_[material]); },
            dark_rule);
    }

    void opacities() const {
        constexpr std::uint32_t none = UINT32_MAX;
        with_real<1>(array_.opacity, [&](auto opacity) {
            check(
                "material", array_.count,
                [&](std::size_t i) { return opacity(i) >= least_opaque ? none : material(i); },
                [&](std::uint32_t material) { return material >= materials_.size() || is_plain(materials_[material]); },
                [](std::uint32_t) { return plain_rule; });
        });
    }

    std::size_t elements(const pt_column &column) const { return column.stride_bytes == 0 ? 1 : array_.count; }

    std::uint32_t material(std::size_t i) const {
        return is_there(array_.material) ? element<std::uint32_t>(array_.material, i) : 0;
    }

    template <typename Holds>
    void check_materials(Holds holds, const std::string &rule) const {
        if (is_there(array_.material))
            check(
                "material", elements(array_.material), [&](std::size_t i) { return material(i); }, holds,
                [&](std::uint32_t) { return std::string_view(rule); });
        else
            subject_.require(holds(0), "material", 0U, rule);
    }

    template <typename Read, typename Holds, typename RuleOf>
    void check(const char *name, std::size_t count, Read read, Holds holds, RuleOf rule) const {
        constexpr std::size_t between_looks = 4096;
        for (std::size_t first = 0; first < count; first += between_looks) {
            const std::size_t end = std::min(count, first + between_looks);
            for (std::size_t i = first; i < end; ++i)
                if (const auto value = read(i); !holds(value))
                    subject_.refuse_element(name, i, value, rule(value));
            progress_.add(end - first);
        }
    }

    const Subject &subject_;
    const pt_sphere_array &array_;
    std::span<const pt_material> materials_;
    WorkProgress &progress_;
};

#define PT_KIND(name, component, components, types, rule, is_needed, initial, set)                                     \
    {#name,      &pt_sphere_array::name,                                                                               \
     components, types##_type,                                                                                         \
     is_needed,  &ColumnChecker::values<rule, component, components>},
const ColumnKind kinds[] = {PT_SPHERE_COLUMNS(PT_KIND)};
#undef PT_KIND

std::uint32_t component_bytes(std::uint32_t type) {
    if (type == PT_TYPE_FLOAT64)
        return sizeof(double);
    return type == PT_TYPE_SRGB8 ? 1 : sizeof(float);
}

std::string member(const ColumnKind &kind, const char *name) {
    return std::string(kind.name) + '.' + name;
}

bool check_layout(const Subject &array, const pt_column &column, std::uint32_t count, const ColumnKind &kind) {
    const auto refuse = [&](const char *name, const std::string &value, const std::string &rule) {
        array.refuse(member(kind, name).c_str(), value, rule);
        return false;
    };
    if (!is_there(column)) {
        if (kind.is_needed)
            return refuse("data", "NULL", "must not be NULL, as count is " + number_text(count));
        return (column.type == 0 && column.stride_bytes == 0) ||
               refuse("data", "NULL", "must not be NULL where type or stride_bytes is set");
    }
    if (!kind.type.is(column.type))
        return refuse("type", number_text(column.type), kind.type.rule);
    const std::uint32_t bytes = kind.components * component_bytes(column.type);
    if (column.stride_bytes > max_stride)
        return refuse("stride_bytes", number_text(column.stride_bytes), "must be < 2^31");
    return column.stride_bytes == 0 || column.stride_bytes >= bytes ||
           refuse("stride_bytes", number_text(column.stride_bytes),
                  "must be 0 or at least the " + number_text(bytes) + " bytes of one element");
}

bool check_layout(const Subject &subject, const pt_sphere_array &array) {
    bool readable = true;
    for (const ColumnKind &kind : kinds)
        readable &= check_layout(subject, array.*kind.column, array.count, kind);
    if (is_there(array.end) && is_there(array.motion)) {
        subject.refuse("motion.data", "set", "must be NULL with end.data, because capsules do not move");
        return false;
    }
    return readable;
}

} // namespace

std::vector<pt_sphere_array> copied_sphere_arrays(const pt_scene &scene, Violations &violations) {
    const Subject whole(violations, "scene");
    const std::uint32_t count = scene.sphere_array_count;
    if (count == 0)
        return {};
    if (!scene.sphere_arrays)
        whole.refuse("sphere_arrays", "NULL", "must not be NULL, as sphere_array_count is " + number_text(count));
    whole.require(count <= max_array_count, "sphere_array_count", count, "must be <= 65536");
    if (!scene.sphere_arrays || count > max_array_count)
        return {};

    std::vector<pt_sphere_array> arrays;
    arrays.reserve(count);
    const std::uint32_t distance = struct_size_of(scene.sphere_arrays, "sphere_arrays", 0);
    const auto *first = reinterpret_cast<const unsigned char *>(scene.sphere_arrays);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto *array = reinterpret_cast<const pt_sphere_array *>(first + std::size_t{i} * distance);
        const std::uint32_t size = struct_size_of(array, "sphere_arrays", i);
        if (size != distance)
            throw Error(PT_ERROR_INVALID_ARGUMENT,
                        wrong_size("sphere_arrays", i, size,
                                   "must be equal to that of sphere_arrays[0] (" + number_text(distance) + ")"));
        arrays.push_back(copy_in(array, "sphere_arrays", i));
    }
    return arrays;
}

double elements_of(std::span<const pt_sphere_array> arrays) {
    double elements = 0.0;
    for (const pt_sphere_array &array : arrays)
        for (const ColumnKind &kind : kinds)
            elements += is_there(array.*kind.column) ? array.count : 0;
    return elements;
}

void check_sphere_arrays(std::span<const pt_sphere_array> arrays, std::span<const pt_material> materials,
                         Violations &violations, WorkProgress &progress) {
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        const Subject subject(violations, "sphere_arrays", i);
        if (arrays[i].count == 0 || !check_layout(subject, arrays[i]))
            continue;
        const ColumnChecker checker(subject, arrays[i], materials, progress);
        for (const ColumnKind &kind : kinds)
            if (is_there(arrays[i].*kind.column) || kind.column == &pt_sphere_array::material)
                (checker.*kind.check)(kind);
    }
}

std::string material_rule(std::uint32_t material_count) {
    return "must be < material_count (" + number_text(material_count) + ")";
}

} // namespace pt
