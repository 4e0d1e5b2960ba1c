// Adds up the lengths of the blocks; see scene_blocks.h.
#include "lib/kernel/scene_blocks.h"

namespace pt {

SceneBlocks::SceneBlocks(const Features &features) {
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

} // namespace pt
