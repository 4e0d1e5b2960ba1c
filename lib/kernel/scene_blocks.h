// Where the blocks of the scene buffer begin, as shaders/gpu_layout.h describes them. Used by gpu_scene, which fills
// them, and by features_of, which asks how long they are.
#pragma once

#include "lib/kernel/scene_features.h"

#include <cstdint>

namespace pt {

// All positions count words of four floats, in 64 bits: the 2^30 surfaces that a scene may have can take more than 5
// words each.
struct SceneBlocks {
    std::uint64_t emission;
    // Reflection of surface i, or of material i of the table: at this + i * reflection_step.
    std::uint64_t diffuse;
    std::uint64_t specular;
    std::uint64_t reflection_step;
    std::uint64_t motion;
    std::uint64_t curvature;
    std::uint64_t lamp_tree;
    std::uint64_t spots; // only with spots, and then the scene is in the uniform buffer
    std::uint64_t index; // only if the scene is not in the uniform buffer
    std::uint64_t tree;  // only with a tree
    std::uint64_t word_count;

    explicit SceneBlocks(const Features &features);
};

} // namespace pt
