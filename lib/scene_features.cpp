// Finds the features of a scene; see scene_features.h.
#include "scene_features.h"

#include "point_sequence.h"

#include <algorithm>

namespace pt {

namespace {

bool emits(const Material &material) {
    return material.emission != glm::vec3(0.0F);
}

} // namespace

Features features_of(const Scene &scene, const Camera &camera, const RenderSettings &render) {
    const auto is_lamp = [&](const Sphere &sphere) { return emits(scene.materials[sphere.material]); };
    const auto is_glossy = [&](const auto &surface) {
        return scene.materials[surface.material].specular != glm::vec3(0.0F);
    };
    const auto moves = [](const Sphere &sphere) { return sphere.motion != glm::dvec3(0.0); };

    Features features{};
    features.sphere_count = static_cast<std::uint32_t>(scene.spheres.size());
    features.plane_count = static_cast<std::uint32_t>(scene.planes.size());
    features.lamp_count = static_cast<std::uint32_t>(std::ranges::count_if(scene.spheres, is_lamp));
    features.max_path_length = render.max_path_length;
    features.estimator = render.estimator;
    features.sampler = render.sampler;
    features.gloss = std::ranges::any_of(scene.spheres, is_glossy) || std::ranges::any_of(scene.planes, is_glossy);
    features.motion = camera.shutter_close > camera.shutter_open && std::ranges::any_of(scene.spheres, moves);
    features.scene_in_uniform = scene_word_count(features) <= gpu::UNIFORM_SCENE_WORDS;
    return features;
}

std::uint32_t scene_word_count(const Features &features) {
    const std::uint32_t words_per_surface = features.gloss ? 4 : 3;
    return words_per_surface * features.surface_count() + (features.motion ? features.sphere_count : 0);
}

std::uint32_t table_dimensions(const Features &features) {
    if (features.sampler == PT_SAMPLER_RANDOM)
        return 0;
    const std::uint32_t vertex = gpu::lamp_dimensions(features.lamp_count) +
                                 gpu::direction_dimensions(features.gloss ? 1 : 0, features.max_path_length);
    const std::uint32_t count =
        gpu::camera_dimensions(features.motion ? 1 : 0) + (features.max_path_length - 1) * vertex;
    return std::min(count, sequence_dimensions);
}

std::array<std::uint32_t, gpu::CONSTANT_COUNT> specialization_constants(const Features &features) {
    std::array<std::uint32_t, gpu::CONSTANT_COUNT> constants{};
    constants[gpu::ID_SPHERE_COUNT] = features.sphere_count;
    constants[gpu::ID_PLANE_COUNT] = features.plane_count;
    constants[gpu::ID_LAMP_COUNT] = features.lamp_count;
    constants[gpu::ID_MAX_PATH_LENGTH] = features.max_path_length;
    constants[gpu::ID_ESTIMATOR] = features.estimator;
    constants[gpu::ID_GLOSS] = features.gloss ? 1 : 0;
    constants[gpu::ID_MOTION] = features.motion ? 1 : 0;
    constants[gpu::ID_SAMPLER] = features.sampler;
    constants[gpu::ID_TABLE_DIMENSIONS] = table_dimensions(features);
    constants[gpu::ID_SCENE_IN_UNIFORM] = features.scene_in_uniform ? 1 : 0;
    return constants;
}

std::uint64_t loop_trips_per_sample(const Features &features) {
    // One trip of the sample loop and a walk over the surfaces for the camera ray; at each further vertex one trip of the
    // path loop, two walks over the lamps, and one over the surfaces for each lamp that is sampled.
    const std::uint64_t surfaces = features.surface_count();
    const std::uint64_t sampled = std::clamp(features.lamp_count, 1U, gpu::EVERY_LAMP_LIMIT);
    const std::uint64_t vertex = 1 + 2 * std::uint64_t{features.lamp_count} + sampled * surfaces;
    return 1 + surfaces + (features.max_path_length - 1) * vertex;
}

std::uint64_t surface_tests_per_path(const Features &features) {
    // The camera ray, then from each vertex but the last the next ray and one to each lamp that is sampled; an empty scene
    // still costs something.
    const std::uint64_t rays = 1 + std::min(features.lamp_count, gpu::EVERY_LAMP_LIMIT);
    return std::max<std::uint64_t>(1, features.surface_count()) * (1 + rays * (features.max_path_length - 1));
}

std::uint32_t feature_bits(const Features &features) {
    std::uint32_t bits = 0;
    bits |= features.lamp_count > 0 ? PT_FEATURE_LAMPS : 0;
    bits |= features.gloss ? PT_FEATURE_GLOSS : 0;
    bits |= features.motion ? PT_FEATURE_MOTION : 0;
    bits |= features.scene_in_uniform ? 0 : PT_FEATURE_LARGE;
    return bits;
}

} // namespace pt
