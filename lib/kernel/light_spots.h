// Which surfaces are spots: far brighter than others as seen from where they are small, so that rays by chance find
// their light rarely, and much of it at a time (shaders/spots.glsl).
#pragma once

#include "lib/kernel/kernel_surfaces.h"
#include "lib/kernel/scene_features.h"
#include "lib/scene/scene.h"

#include <cstdint>
#include <vector>

namespace pt {

// By kernel indices of lamp and surface.
struct LightSpot {
    std::uint32_t lamp;
    std::uint32_t surface;
    float reflectance; // mean of R, G and B of what makes the spot
    float glossiness;  // of a mirror image; -1 for a glow
};

// None where paths are too short to go by way of one, or lamps are many; nor where there are more than SPOT_LIMIT, as
// what they cost grows with their number. What the camera sees does not matter: a camera that moves keeps its kernel.
// features: of the surfaces, without spots.
std::vector<LightSpot> light_spots(const KernelSurfaces &surfaces, const std::vector<Material> &materials,
                                   const Features &features);

} // namespace pt
