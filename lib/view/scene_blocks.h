#pragma once

#include "lib/view/scene_features.h"
#include "shaders/gpu_layout.h"

#include <bit>
#include <cstdint>
#include <span>

namespace pt {

// First words of the scene buffer's blocks (gpu_layout.h). 2^30 surfaces can take more than 2^32 words.
struct SceneBlocks {
    std::uint64_t emission;
    // The diffuse word of surface or material i is diffuse + i * reflection_step.
    std::uint64_t diffuse;
    std::uint64_t specular;
    std::uint64_t reflection_step;
    std::uint64_t motion;
    std::uint64_t curvature;
    std::uint64_t lamp_tree;
    std::uint64_t spots; // only in the uniform buffer
    std::uint64_t index; // only in the storage buffer
    std::uint64_t tree;  // only with a tree
    std::uint64_t word_count;

    explicit SceneBlocks(const Features &features);
};

inline SceneBlocks::SceneBlocks(const Features &features) {
    const std::uint64_t surfaces = features.surface_count();
    const std::uint64_t gloss = features[gpu::ID_GLOSS];
    const std::uint64_t emitting_planes = features[gpu::ID_PLANES_EMIT] ? features[gpu::ID_PLANE_COUNT] : 0;
    emission = surfaces;
    motion =
        features.scene_in_uniform() ? (3 + gloss) * surfaces : emission + features.emitting_spheres() + emitting_planes;
    curvature = motion + (features.has_ways() ? features[gpu::ID_SPHERE_COUNT] : 0);
    lamp_tree = curvature + (features[gpu::ID_CURVATURE] ? features[gpu::ID_PLANE_COUNT] : 0);
    index = lamp_tree + features[gpu::ID_LAMP_TREE_WORDS];
    if (features.scene_in_uniform()) {
        diffuse = 2 * surfaces;
        specular = 3 * surfaces;
        reflection_step = 1;
        spots = index;
        word_count = spots + features[gpu::ID_SPOT_COUNT];
    } else {
        tree = index + (surfaces + 3) / 4;
        diffuse = tree + (features[gpu::ID_TREE] ? sizeof(gpu::TreeFrame) / sizeof(glm::vec4) : 0);
        specular = diffuse + 1;
        reflection_step = 1 + gloss;
        word_count = diffuse + reflection_step * features.table_materials;
    }
}

inline void write_number(std::span<glm::vec4> block, std::uint64_t place, std::uint32_t number) {
    block[place / 4][static_cast<int>(place % 4)] = std::bit_cast<float>(gpu::MATERIAL_INDEX_BITS + number);
}

} // namespace pt
