// Which surfaces are spots: far brighter than others as seen from where they are small, so that rays by chance find
// their light rarely, and much of it at a time (shaders/spots.glsl).
#pragma once

#include "lib/kernel/kernel_surfaces.h"
#include "lib/kernel/scene_features.h"
#include "lib/scene/scene.h"

#include <cstdint>
#include <vector>

namespace pt {

// The lamp and the surface, by their numbers in kernels.
struct LightSpot {
    std::uint32_t lamp;
    std::uint32_t surface;
    float reflectance; // mean of R, G and B of what makes the spot
    float glossiness;  // of a mirror image; -1 for a glow
};

// None where paths are too short to use one or where there are many lamps; none either if there would be more than
// SPOT_LIMIT, since their cost grows with their number. The camera does not matter, so a moving camera keeps its
// kernel. features: of the surfaces, without spots.
std::vector<LightSpot> light_spots(const KernelSurfaces &surfaces, const std::vector<Material> &materials,
                                   const Features &features);

} // namespace pt
