// A scene as kernels read it, seen by one camera: twins merged, in the kernels' order, in float32 (layout:
// shaders/gpu_layout.h).
#pragma once

#include "lib/kernel/prepared_scene.h"
#include "lib/kernel/scene_features.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "shaders/gpu_layout.h"

#include <memory>
#include <vector>

namespace pt {

struct GpuScene {
    Features features;
    // The scene buffer. Positions are relative to the camera, subtracted in double. Motion covers the shutter's time.
    std::vector<glm::vec4> words;
    gpu::FrameConstants frame;
    std::shared_ptr<const SphereTree> tree; // may be NULL
    double start_distance;                  // pinhole to the coordinates' origin, along the view
    std::vector<std::uint32_t> objects;     // scene indices of the surfaces outside the tree

    // surface: the kernels' number. PT_NO_OBJECT for NO_SURFACE.
    std::uint32_t object_of(std::uint32_t surface) const;
};

// Throws PT_ERROR_UNSUPPORTED if a sphere that must be held as a plane moves too far.
GpuScene gpu_scene(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings);

// distinct: with twins merged. start: where camera rays start.
GpuScene gpu_scene(const DistinctScene &distinct, const PreparedScene &scene, const Camera &start,
                   const RenderSettings &settings);

} // namespace pt
