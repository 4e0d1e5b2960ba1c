// Takes a scene over from the caller; see scene.h.
#include "lib/scene/scene.h"

#include "lib/scene/checked_scene.h"
#include "lib/scene/distinct_materials.h"

#include <algorithm>
#include <utility>

namespace pt {

namespace {

// Makes a material for each sphere color, or reuses an equal one that exists already.
class ColoredMaterials {
public:
    explicit ColoredMaterials(std::vector<Material> &materials) : materials_(materials), distinct_(materials) {
        for (std::uint32_t i = 0; i < materials_.size(); ++i)
            distinct_.first_equal(i);
    }

    std::uint32_t index_of(std::uint32_t material, const glm::vec3 &color) {
        Material colored = materials_[material];
        colored.diffuse *= color;
        if (colored.diffuse == materials_[material].diffuse)
            return material;
        const auto added = static_cast<std::uint32_t>(materials_.size());
        materials_.push_back(colored);
        const std::uint32_t first = distinct_.first_equal(added);
        if (first != added)
            materials_.pop_back();
        return first;
    }

private:
    std::vector<Material> &materials_;
    DistinctMaterials distinct_;
};

void append_spheres(Scene &scene, const SphereSource &source) {
    scene.spheres.reserve(source.size());
    if (!source.has_colors()) {
        source.for_each([&](std::size_t, const Sphere &sphere, const glm::vec3 &) { scene.spheres.push_back(sphere); });
        return;
    }
    ColoredMaterials colored(scene.materials);
    source.for_each([&](std::size_t, Sphere sphere, const glm::vec3 &color) {
        sphere.material = colored.index_of(sphere.material, color);
        scene.spheres.push_back(sphere);
    });
}

} // namespace

Scene owned_scene(CheckedScene checked) {
    const auto starts = checked.spheres.array_starts();
    Scene owned{std::move(checked.materials), {}, std::move(checked.planes), {starts.begin(), starts.end()}};
    append_spheres(owned, checked.spheres);
    return owned;
}

Scene owned_scene_of(const CheckedScene &checked, const std::vector<std::uint32_t> &spheres) {
    const auto starts = checked.spheres.array_starts();
    Scene owned{checked.materials, {}, checked.planes, {starts.begin(), starts.end()}, spheres};
    ColoredMaterials colored(owned.materials);
    for (const std::uint32_t index : spheres) {
        owned.spheres.push_back(checked.spheres[index]);
        Sphere &sphere = owned.spheres.back();
        sphere.material = colored.index_of(sphere.material, checked.spheres.color(index));
    }
    return owned;
}

SpherePlace place_of_sphere(const Scene &scene, std::size_t position) {
    const std::size_t index = scene.indices.empty() ? position : scene.indices[position];
    const auto after = std::ranges::upper_bound(scene.array_starts, index);
    const auto array = after - scene.array_starts.begin() - 1;
    if (array < 0)
        return {"spheres", static_cast<std::int64_t>(index), -1};
    return {"sphere_arrays", array, static_cast<std::int32_t>(index - *(after - 1))};
}

} // namespace pt
