// Which surfaces have spots: small places that are far brighter than all others, so that random rays seldom find their
// light, and then much of it at once (shaders/spots.glsl).
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
