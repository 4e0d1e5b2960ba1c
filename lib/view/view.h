// A scene for one camera, in the layout of gpu_layout.h.
#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "lib/view/prepared_scene.h"
#include "lib/view/scene_features.h"
#include "shaders/gpu_layout.h"

#include <memory>
#include <vector>

namespace pt {

struct View {
    Features features;
    // Positions are relative to the camera. Motions are displacements while the shutter is open.
    std::vector<glm::vec4> words;
    gpu::FrameConstants frame;
    std::shared_ptr<const SphereTree> tree; // NULL without a tree
    double start_distance;                  // distance from the pinhole to the origin of coordinates
    std::vector<std::uint32_t> objects;     // scene indices of surfaces outside the tree

    std::uint32_t object_of(std::uint32_t surface) const;
};

// Throws PT_ERROR_UNSUPPORTED if a nearly flat sphere moves too far.
View view_of(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings);

View view_of(const SeenScene &distinct, const PreparedScene &scene, const Camera &start,
             const RenderSettings &settings);

} // namespace pt
