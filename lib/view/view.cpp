#include "lib/view/view.h"

#include "lib/base/mixed.h"
#include "lib/view/lamp_tree_words.h"
#include "lib/view/light_spots.h"
#include "lib/view/projection.h"
#include "lib/view/scene_blocks.h"
#include "lib/view/seen_scene.h"
#include "lib/view/twins.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numbers>
#include <span>
#include <utility>

namespace pt {

namespace {

// Proportional to specular reflectance. Diffuse reflectance counts twice, because its light comes from a hemisphere and
// varies more.
float specular_probability(const Material &material) {
    const float specular = mean(material.specular);
    const float diffuse = 2.0F * mean(material.diffuse);
    if (specular == 0.0F || diffuse == 0.0F)
        return specular > 0.0F ? 1.0F : 0.0F;
    return std::clamp(specular / (specular + diffuse), 1e-3F, 1.0F - 1e-3F);
}

class Writer {
public:
    Writer(std::vector<glm::vec4> &words, const Features &features) :
        words_(words),
        features_(features),
        blocks_(features) {}

    void emission(std::uint32_t surface, const Material &material) {
        if (features_.scene_in_uniform() || may_emit(surface))
            write_emission(emission_word(surface), material);
    }

    void reflection(std::uint32_t index, const Material &material) {
        const double lobe = (material.glossiness + 2.0) / (2.0 * std::numbers::pi);
        const glm::dvec3 diffuse = glm::dvec3(material.diffuse) / std::numbers::pi;
        const std::uint64_t word = blocks_.reflection_step * index;
        words_[blocks_.diffuse + word] = glm::vec4(glm::vec3(diffuse), specular_probability(material));
        if (features_[gpu::ID_GLOSS])
            words_[blocks_.specular + word] =
                glm::vec4(glm::vec3(glm::dvec3(material.specular) * lobe), material.glossiness);
    }

    void material_index(std::uint32_t surface, std::uint32_t index) {
        write_number(std::span(words_).subspan(blocks_.index), surface, index);
    }

    void sphere(std::uint32_t surface, const SeenSphere &sphere) {
        words_[surface] = glm::vec4(glm::vec3(sphere.open), static_cast<float>(sphere.radius));
        if (features_.has_ways())
            words_[blocks_.motion + surface] = way_word(sphere);
    }

    void plane(std::uint32_t surface, const CurvedPlane &plane) {
        words_[surface] = glm::vec4(glm::vec3(plane.normal), static_cast<float>(plane.offset));
        if (features_[gpu::ID_CURVATURE])
            words_[blocks_.curvature + surface - features_[gpu::ID_SPHERE_COUNT]] =
                glm::vec4(static_cast<float>(plane.curvature), glm::vec3(plane.way));
    }

    void spot(std::uint32_t index, const LightSpot &spot) {
        words_[blocks_.spots + index] = {std::bit_cast<float>(gpu::MATERIAL_INDEX_BITS + spot.lamp),
                                         std::bit_cast<float>(gpu::MATERIAL_INDEX_BITS + spot.surface),
                                         spot.reflectance, spot.glossiness};
    }

    void tree(const SphereTree &tree, const Camera &camera, const std::vector<Material> &materials) {
        const gpu::TreeFrame frame = tree.frame(camera);
        std::memcpy(&words_[blocks_.tree], &frame, sizeof frame);
        std::uint64_t word = blocks_.emission + features_.walked_lamps();
        for (const std::uint32_t material : tree.lamp_materials())
            write_emission(word++, materials[material]);
    }

private:
    // Adds 0 to turn -0 into +0, because the film rejects -0.
    void write_emission(std::uint64_t word, const Material &material) {
        words_[word] = glm::vec4(material.emission + 0.0F, mean(material.emission));
    }

    bool may_emit(std::uint32_t surface) const {
        return surface < features_.walked_lamps() + features_[gpu::ID_SKY_COUNT] ||
               (features_[gpu::ID_PLANES_EMIT] && surface >= features_[gpu::ID_SPHERE_COUNT]);
    }

    std::uint64_t emission_word(std::uint32_t surface) const {
        if (features_.scene_in_uniform() || surface < features_.walked_lamps())
            return blocks_.emission + surface;
        if (surface < features_[gpu::ID_SPHERE_COUNT])
            return blocks_.emission + features_[gpu::ID_TREE_LAMPS] + surface;
        return blocks_.emission + features_.emitting_spheres() + surface - features_[gpu::ID_SPHERE_COUNT];
    }

    std::vector<glm::vec4> &words_;
    const Features &features_;
    const SceneBlocks blocks_;
};

std::vector<Lamp> lamps_in_tree_order(const KernelSurfaces &surfaces, const PreparedScene &scene,
                                      const Camera &camera) {
    constexpr std::uint32_t no_lamp = 0xffffffff;
    const auto sphere_count = static_cast<std::uint32_t>(scene.scene.spheres.size());
    std::vector<std::uint32_t> lamp_of_sphere(sphere_count, no_lamp);
    for (std::uint32_t lamp = 0; lamp < surfaces.lamp_count; ++lamp)
        lamp_of_sphere[surfaces.spheres[lamp].index] = lamp;
    std::vector<Lamp> lamps;
    lamps.reserve(scene.lamp_order.size());
    for (const std::uint32_t sphere : scene.lamp_order) {
        if (sphere >= sphere_count) {
            const Sphere in_tree = scene.tree->lamp(sphere - sphere_count);
            lamps.push_back(lamp_of(in_tree, scene.scene.materials[in_tree.material], camera));
            lamps.back().number = surfaces.lamp_count + sphere - sphere_count;
        } else if (const std::uint32_t lamp = lamp_of_sphere[sphere]; lamp != no_lamp) {
            const SeenSphere &seen = surfaces.spheres[lamp];
            lamps.push_back({ball_about(seen), scene.scene.materials[seen.material].emission, seen.hidden, lamp});
        }
    }
    return lamps;
}

std::vector<glm::vec4> words_of(const KernelSurfaces &surfaces, const std::vector<LightSpot> &spots,
                                const PreparedScene &scene, const Camera &camera, const Features &features) {
    std::vector<glm::vec4> words(SceneBlocks(features).word_count);
    Writer writer(words, features);
    std::uint32_t surface = 0;
    const auto write_material = [&](std::uint32_t material) {
        writer.emission(surface, scene.scene.materials[material]);
        if (features.scene_in_uniform())
            writer.reflection(surface, scene.scene.materials[material]);
        else
            writer.material_index(surface, scene.used_indices[material]);
    };
    for (const SeenSphere &sphere : surfaces.spheres) {
        write_material(sphere.material);
        writer.sphere(surface++, sphere);
    }
    for (const CurvedPlane &plane : surfaces.planes) {
        write_material(plane.material);
        writer.plane(surface++, plane);
    }
    for (std::uint32_t i = 0; i < features.table_materials; ++i)
        writer.reflection(i, scene.used_materials[i]);
    for (std::uint32_t i = 0; i < features[gpu::ID_SPOT_COUNT]; ++i)
        writer.spot(i, spots[i]);
    if (scene.tree)
        writer.tree(*scene.tree, camera, scene.scene.materials);
    if (features[gpu::ID_LAMP_TREE_WORDS] > 0) {
        const SceneBlocks blocks(features);
        write_lamp_tree(std::span(words).subspan(blocks.lamp_tree, features[gpu::ID_LAMP_TREE_WORDS]),
                        lamps_in_tree_order(surfaces, scene, camera), features[gpu::ID_MOTION]);
    }
    return words;
}

gpu::FrameConstants frame_constants(const Camera &camera, const RenderSettings &render, double film_unit) {
    const std::uint64_t seed = mixed(render.seed);
    gpu::FrameConstants constants{};
    constants.camera = projection_of(camera, render.width, render.height)->rays();
    constants.seed = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
    constants.film_scale = static_cast<float>(1.0 / film_unit);
    return constants;
}

std::vector<std::uint32_t> objects_of(const KernelSurfaces &surfaces, const PreparedScene &scene) {
    const Scene &held = scene.scene;
    const std::size_t sphere_count = scene.tree ? scene.tree->scene_sphere_count() : held.spheres.size();
    const auto of_sphere = [&](std::uint32_t index) { return held.indices.empty() ? index : held.indices[index]; };
    std::vector<std::uint32_t> objects;
    for (const SeenSphere &sphere : surfaces.spheres)
        objects.push_back(of_sphere(sphere.index));
    for (const CurvedPlane &plane : surfaces.planes) {
        const bool is_sphere = plane.curvature > 0.0;
        objects.push_back(is_sphere ? of_sphere(plane.index) : static_cast<std::uint32_t>(sphere_count) + plane.index);
    }
    return objects;
}

} // namespace

std::uint32_t View::object_of(std::uint32_t surface) const {
    if (surface == gpu::NO_SURFACE)
        return PT_NO_OBJECT;
    return surface < objects.size() ? objects[surface] : tree->spheres()[surface - objects.size()];
}

View view_of(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings) {
    const Camera start =
        projection_of(camera, settings.width, settings.height)->starting_ahead(scene.scene, scene.tree.get());
    SeenScene seen = seen_scene(scene.scene, start);
    require_held_motions(seen, scene.scene, start);
    return view_of(without_twins(std::move(seen)), scene, start, settings);
}

View view_of(const SeenScene &distinct, const PreparedScene &scene, const Camera &start,
             const RenderSettings &settings) {
    const KernelSurfaces surfaces = kernel_surfaces(distinct, scene.tree.get(), start);
    Features features = features_of(distinct, surfaces, scene, start, settings);
    const std::vector<LightSpot> spots = light_spots(surfaces, scene.scene.materials, features);
    features[gpu::ID_SPOT_COUNT] = static_cast<std::uint32_t>(spots.size());
    return {features,
            words_of(surfaces, spots, scene, start, features),
            frame_constants(start, settings, scene.film_unit),
            scene.tree,
            start.start_distance,
            objects_of(surfaces, scene)};
}

} // namespace pt
