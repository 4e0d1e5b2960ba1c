#include "lib/scene/checked_scene.h"

#include "lib/base/rules.h"
#include "lib/base/scaled_vector.h"
#include "lib/scene/sphere_array_rules.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <string>

namespace pt {

namespace {

// Positions in the scene buffer have 32 bits.
constexpr std::uint64_t max_surface_count = std::uint64_t{1} << 30;

constexpr double share_of_checks = 0.08;

glm::vec3 color(const float (&components)[3]) {
    return {components[0], components[1], components[2]};
}

// The square of an unscaled normal may overflow.
Plane normalized(const pt_plane &plane) {
    const auto [normal, exponent] = scaled(vector(plane.normal));
    const double length = glm::length(normal);
    return {normal / length, std::ldexp(plane.offset, -exponent) / length, plane.material};
}

Material owned(const pt_material &material) {
    return {color(material.diffuse), color(material.specular), color(material.emission), material.glossiness,
            (material.flags & PT_MATERIAL_HIDDEN_FROM_CAMERA) != 0};
}

class Checker {
public:
    Checker(Violations &violations, std::uint32_t material_count) :
        violations_(violations),
        material_count_(material_count),
        material_rule_(material_rule(material_count)) {}

    void check(const pt_material &source, std::size_t index) const {
        const Subject material(violations_, "materials", index);
        material.check_each("diffuse", source.diffuse, color_rule);
        material.check_each("specular", source.specular, color_rule);
        material.check_each("emission", source.emission, color_rule);
        material.check("glossiness", source.glossiness, glossiness_rule);
        material.require(source.flags <= PT_MATERIAL_HIDDEN_FROM_CAMERA, "flags", source.flags,
                         "must be 0 or PT_MATERIAL_HIDDEN_FROM_CAMERA (1)");
    }

    void check(const pt_sphere &source, std::size_t index) const {
        const Subject sphere(violations_, "spheres", index);
        sphere.check_each("center", source.center, length_rule);
        sphere.check("radius", source.radius, positive_length_rule);
        sphere.check_each("motion", source.motion, length_rule);
        sphere.require(source.material < material_count_, "material", source.material, material_rule_);
        sphere.require(source.reserved == 0, "reserved", source.reserved, "must be 0");
    }

    void check(const pt_plane &source, std::size_t index) const {
        const Subject plane(violations_, "planes", index);
        const glm::dvec3 normal = vector(source.normal);
        const bool finite = std::ranges::all_of(source.normal, [](double x) { return std::isfinite(x); });
        const bool has_direction = finite && normal != glm::dvec3(0.0);
        plane.check_each("normal", source.normal, finite_rule);
        plane.require(!finite || has_direction, "normal", normal, "must not be zero");
        plane.check("offset", source.offset, finite_rule);
        if (has_direction && std::isfinite(source.offset))
            plane.require(is_length_after_division(source), "offset", source.offset,
                          "must be 0 or of a magnitude in [1e-18, 1e18] after division by the normal's length");
        plane.require(source.material < material_count_, "material", source.material, material_rule_);
        plane.require(source.reserved == 0, "reserved", source.reserved, "must be 0");
    }

private:
    static bool is_length_after_division(const pt_plane &plane) {
        const double offset = normalized(plane).offset;
        const bool underflowed = offset == 0.0 && plane.offset != 0.0;
        return !underflowed && length_rule(offset) == nullptr;
    }

    Violations &violations_;
    std::uint32_t material_count_;
    std::string material_rule_;
};

template <typename Element>
std::span<const Element> elements(const Element *array, std::uint32_t count, const std::string &name,
                                  Violations &violations) {
    if (array || count == 0)
        return {array, count};
    violations.add({.subject = "scene",
                    .member = name + "s",
                    .value = "NULL",
                    .rule = "must not be NULL, as " + name + "_count is " + std::to_string(count)});
    return {};
}

void check_counts(const Subject &scene, const pt_scene &counts, std::span<const pt_sphere_array> arrays) {
    std::uint64_t sphere_count = counts.sphere_count;
    for (const pt_sphere_array &array : arrays)
        sphere_count += array.count;
    const Member all_spheres("sphere_count", arrays.empty() ? "" : "+ the counts of sphere_arrays");
    scene.require(sphere_count <= max_sphere_count, all_spheres, sphere_count, "must be <= 2^26");
    const std::uint64_t surface_count = sphere_count + counts.plane_count;
    scene.require(surface_count < max_surface_count, {"plane_count", "+ all spheres"}, surface_count, "must be < 2^30");
}

template <typename Element>
void check_all(std::span<const Element> elements, const Checker &checker, WorkProgress &progress) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
        checker.check(elements[i], i);
        progress.add(1);
    }
}

} // namespace

CheckedScene checked_scene(const pt_scene &scene, WorkProgress &progress) {
    Violations violations;
    const std::vector<pt_sphere_array> arrays = copied_sphere_arrays(scene, violations);
    const Subject whole(violations, "scene");
    check_counts(whole, scene, arrays);
    whole.require(scene.reserved == 0, "reserved", scene.reserved, "must be 0");
    // With wrong counts the arrays may not exist.
    violations.throw_if_any(PT_ERROR_INVALID_SCENE);

    const auto materials = elements(scene.materials, scene.material_count, "material", violations);
    const auto spheres = elements(scene.spheres, scene.sphere_count, "sphere", violations);
    const auto planes = elements(scene.planes, scene.plane_count, "plane", violations);
    const Checker checker(violations, scene.material_count);
    progress.enter(share_of_checks,
                   static_cast<double>(materials.size() + spheres.size() + planes.size()) + elements_of(arrays));
    check_all(materials, checker, progress);
    check_all(spheres, checker, progress);
    check_sphere_arrays(arrays, materials, violations, progress);
    check_all(planes, checker, progress);
    violations.throw_if_any(PT_ERROR_INVALID_SCENE);
    CheckedScene checked{{}, SphereSource(spheres, arrays), {}};
    std::ranges::transform(materials, std::back_inserter(checked.materials), owned);
    std::ranges::transform(planes, std::back_inserter(checked.planes), normalized);
    return checked;
}

} // namespace pt
