// What one camera sees of a scene, as kernels read it: twins merged, surfaces in the kernels' order and relative to
// where rays start, in float32, laid out as shaders/gpu_layout.h says. Renderer makes it when the scene, camera or
// settings have changed; all kernels on all devices share it.
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
    // The scene buffer. Positions are made relative to the camera in double precision before they are rounded, so a
    // scene far from the origin looks like one at the origin. Motion is cut down to the time while the shutter is open.
    std::vector<glm::vec4> words;
    gpu::FrameConstants frame;              // what does not change from slice to slice
    std::shared_ptr<const SphereTree> tree; // NULL without
    double start_distance;                  // of the coordinates' origin from the pinhole, along the view (ray_start.h)
    std::vector<std::uint32_t> objects;     // numbers in the caller's scene, of the surfaces that are not in the tree

    // The index of a surface in the caller's scene, by its number in kernels; PT_NO_OBJECT for NO_SURFACE.
    std::uint32_t object_of(std::uint32_t surface) const;
};

// Throws PT_ERROR_UNSUPPORTED if a sphere would have to be held as a plane but moves too far for it.
GpuScene gpu_scene(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings);

// The same for a scene whose twins are merged already, seen from where camera rays start.
GpuScene gpu_scene(const DistinctScene &distinct, const PreparedScene &scene, const Camera &start,
                   const RenderSettings &settings);

} // namespace pt
