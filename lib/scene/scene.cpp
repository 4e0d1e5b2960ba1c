#include "lib/scene/scene.h"

#include "lib/scene/checked_scene.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <utility>

namespace pt {

namespace {

// Floats, because -0 must equal 0.
using MaterialKey = std::array<float, 11>;

MaterialKey key_of(const Material &material) {
    const auto &[diffuse, specular, emission, glossiness, hidden] = material;
    return {diffuse.r,  diffuse.g,  diffuse.b,  specular.r, specular.g,          specular.b,
            emission.r, emission.g, emission.b, glossiness, hidden ? 1.0F : 0.0F};
}

// Adds materials for spheres with their own color. Spheres with equal material and color share one.
class ColoredMaterials {
public:
    explicit ColoredMaterials(std::vector<Material> &materials) : materials_(materials) {}

    std::uint32_t index_of(std::uint32_t material, const Look &look) {
        Material colored = materials_[material];
        for (const LookColumn &each : look_columns)
            each.change(colored, look);
        if (key_of(colored) == key_of(materials_[material]))
            return material;
        if (indices_.empty())
            for (std::uint32_t i = 0; i < materials_.size(); ++i)
                indices_.emplace(key_of(materials_[i]), i);
        const auto [found, is_new] = indices_.emplace(key_of(colored), static_cast<std::uint32_t>(materials_.size()));
        if (is_new)
            materials_.push_back(colored);
        return found->second;
    }

private:
    std::vector<Material> &materials_;
    std::map<MaterialKey, std::uint32_t> indices_;
};

} // namespace

Scene owned_scene(CheckedScene checked, const std::vector<std::uint32_t> *only) {
    const SphereSource &spheres = checked.spheres;
    const auto starts = spheres.array_starts();
    Scene owned{std::move(checked.materials), {}, std::move(checked.planes), {starts.begin(), starts.end()}};
    ColoredMaterials colored(owned.materials);
    WorkProgress nobody;
    const std::function take = [&](std::uint32_t, const Sphere &sphere) {
        owned.spheres.push_back(sphere);
        owned.spheres.back().material = colored.index_of(sphere.material, sphere.look);
    };
    if (only == nullptr) {
        owned.spheres.reserve(spheres.size());
        spheres.for_each(nobody, take);
    } else {
        owned.indices = *only;
        spheres.for_each(*only, nobody, take);
    }
    return owned;
}

SpherePlace place_of_sphere(const Scene &scene, std::size_t position) {
    return place_of_index(scene, scene.indices.empty() ? position : scene.indices[position]);
}

SpherePlace place_of_index(const Scene &scene, std::size_t index) {
    const auto after = std::ranges::upper_bound(scene.array_starts, index);
    const auto array = after - scene.array_starts.begin() - 1;
    if (array < 0)
        return {"spheres", static_cast<std::int64_t>(index), -1};
    return {"sphere_arrays", array, static_cast<std::int32_t>(index - *(after - 1))};
}

void add(Digest &digest, const Material &material) {
    digest.add(material.diffuse);
    digest.add(material.specular);
    digest.add(material.emission);
    digest.add(static_cast<double>(material.glossiness));
    if (material.hidden) // scenes without hidden materials still match old films
        digest.add(std::uint64_t{PT_MATERIAL_HIDDEN_FROM_CAMERA});
}

std::string digest_of(const Scene &scene) {
    Digest digest;
    std::map<MaterialKey, std::uint64_t> numbers;
    const auto add_material = [&](std::uint32_t index) {
        const Material &material = scene.materials[index];
        const auto [found, is_new] = numbers.emplace(key_of(material), numbers.size());
        digest.add(found->second);
        if (is_new)
            add(digest, material);
    };
    for (const std::size_t count : {scene.spheres.size(), scene.planes.size()})
        digest.add(std::uint64_t{count});
    for (const Sphere &sphere : scene.spheres) {
        digest.add(sphere.center);
        digest.add(sphere.radius);
        digest.add(sphere.motion);
        add_kind(digest, sphere.kind);
        add_material(sphere.material);
    }
    for (const Plane &plane : scene.planes) {
        digest.add(plane.normal);
        digest.add(plane.offset);
        add_material(plane.material);
    }
    return digest.text();
}

} // namespace pt
