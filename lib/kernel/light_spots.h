// Finds spots: small places far brighter than others, which random rays seldom find (shaders/spots.glsl).
#pragma once

#include "lib/kernel/kernel_surfaces.h"
#include "lib/kernel/scene_features.h"
#include "lib/scene/scene.h"

#include <cstdint>
#include <vector>

namespace pt {

struct LightSpot {
    std::uint32_t lamp;
    std::uint32_t surface;
    float reflectance; // mean of R, G and B
    float glossiness;  // a mirror image's gloss; -1 for a glow
};

// Empty for short paths, many lamps, or more than SPOT_LIMIT spots. Independent of the camera, so that a moving one
// keeps its kernel. features: without spots.
std::vector<LightSpot> light_spots(const KernelSurfaces &surfaces, const std::vector<Material> &materials,
                                   const Features &features);

} // namespace pt
