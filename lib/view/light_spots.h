#pragma once

#include "lib/scene/scene.h"
#include "lib/view/kernel_surfaces.h"
#include "lib/view/scene_features.h"

#include <cstdint>
#include <vector>

namespace pt {

struct LightSpot {
    std::uint32_t lamp;
    std::uint32_t surface;
    float reflectance;
    float glossiness; // of the surface that mirrors the lamp; -1: a glow, light of a near lamp on a plane
};

// Returns no spots for short paths, for many lamps, or if there were more than SPOT_LIMIT. Spots do not depend on the
// camera, so a moving camera keeps its kernel.
std::vector<LightSpot> light_spots(const KernelSurfaces &surfaces, const std::vector<Material> &materials,
                                   const Features &features);

} // namespace pt
