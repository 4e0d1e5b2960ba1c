// Adds up the lengths of the blocks; see scene_blocks.h.
#include "lib/kernel/scene_blocks.h"

#include "lib/kernel/lamp_tree_words.h"

namespace pt {

SceneBlocks::SceneBlocks(const Features &features) {
    const std::uint64_t surfaces = features.surface_count();
    const std::uint64_t gloss = features.gloss ? 1 : 0;
    const std::uint64_t emitting_planes = features.planes_emit ? features.plane_count : 0;
    emission = surfaces;
    motion =
        features.scene_in_uniform ? (3 + gloss) * surfaces : emission + features.emitting_spheres() + emitting_planes;
    curvature = motion + (features.motion || features.capsules ? features.sphere_count : 0);
    lamp_tree = curvature + (features.curvature ? features.plane_count : 0);
    index = lamp_tree + (features.lamp_tree ? lamp_tree_words(features.lamp_count, features.motion) : 0);
    if (features.scene_in_uniform) {
        diffuse = 2 * surfaces;
        specular = 3 * surfaces;
        reflection_step = 1;
        spots = index;
        word_count = spots + features.spot_count;
    } else {
        tree = index + (surfaces + 3) / 4;
        diffuse = tree + (features.tree ? sizeof(gpu::TreeFrame) / sizeof(glm::vec4) : 0);
        specular = diffuse + 1;
        reflection_step = 1 + gloss;
        word_count = diffuse + reflection_step * features.table_materials;
    }
}

} // namespace pt
