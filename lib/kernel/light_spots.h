// Finds spots: small places far brighter than all others, whose light random rays seldom find, and then much at once
// (shaders/spots.glsl).
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
    float glossiness;  // of a mirror image; -1 for a glow
};

// None if paths are too short, if there are many lamps, or if there would be more than SPOT_LIMIT, as costs grow with
// their number. Independent of the camera, so that a moving camera keeps its kernel. features: without spots.
std::vector<LightSpot> light_spots(const KernelSurfaces &surfaces, const std::vector<Material> &materials,
                                   const Features &features);

} // namespace pt
