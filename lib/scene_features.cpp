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

std::uint32_t branch_count(const Features &features) {
    constexpr std::uint32_t branches = 4;
    constexpr std::uint32_t longest_branching_path = 64;
    return features.max_path_length > 2 && features.max_path_length <= longest_branching_path ? branches : 1;
}

PointLayout point_layout(const Features &features) {
    const std::uint32_t motion = features.motion ? 1 : 0;
    const std::uint32_t shared = gpu::shared_dimensions(motion, features.lamp_count);
    const std::uint32_t branches = branch_count(features);
    if (features.sampler == PT_SAMPLER_RANDOM)
        return {0, 0, branches};
    std::uint32_t count = shared;
    for (std::uint32_t vertex = 1; vertex < features.max_path_length && count < sequence_dimensions; ++vertex)
        count += gpu::chosen_lamp_dimensions(vertex, features.lamp_count) +
                 gpu::direction_dimensions(features.gloss ? 1 : 0, features.max_path_length);
    return {std::min(count, sequence_dimensions), shared, branches};
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
    constants[gpu::ID_TABLE_DIMENSIONS] = point_layout(features).dimensions;
    constants[gpu::ID_BRANCH_COUNT] = branch_count(features);
    constants[gpu::ID_SCENE_IN_UNIFORM] = features.scene_in_uniform ? 1 : 0;
    return constants;
}

std::uint64_t loop_trips_per_sample(const Features &features) {
    // One trip of the sample loop and a walk over the surfaces for the camera ray; at the first vertex a walk for each
    // lamp of a few and two walks over the lamps; at each vertex of a branch one trip of a loop, two walks over the lamps
    // and one over the surfaces.
    const std::uint64_t surfaces = features.surface_count();
    const std::uint64_t lamps = features.lamp_count;
    const std::uint64_t first_vertex =
        std::min<std::uint64_t>(lamps, gpu::EVERY_LAMP_LIMIT) * (1 + surfaces) + 2 * lamps;
    const std::uint64_t vertex = 1 + 2 * lamps + surfaces;
    return 1 + surfaces + first_vertex + branch_count(features) * (features.max_path_length - 1) * vertex;
}

std::uint64_t surface_tests_per_path(const Features &features) {
    // The camera ray, one to each lamp of a few, then from each vertex of a branch the next ray and one to a lamp; an
    // empty scene still costs something.
    const std::uint64_t vertices = branch_count(features) * (features.max_path_length - 1);
    const std::uint64_t rays = 1 + std::min(features.lamp_count, gpu::EVERY_LAMP_LIMIT) + 2 * vertices;
    return std::max<std::uint64_t>(1, features.surface_count()) * rays;
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
