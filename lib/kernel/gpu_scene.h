// What one camera sees of a scene, as kernels read it: surfaces that are one taken for one, in the kernels' order,
// relative to where rays start, in float32, laid out as shaders/gpu_layout.h says. Made once by Renderer when scene,
// camera or settings have changed: all kernels of all devices share it.
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
    // The scene buffer. Positions are taken relative to the camera in double before they are rounded, so that a scene
    // far from the origin looks like one at it; motion is restricted to the time in which the shutter is open.
    std::vector<glm::vec4> words;
    gpu::FrameConstants frame; // what does not change from slice to slice
    double film_unit;
    std::shared_ptr<const SphereTree> tree; // NULL without
    double start_distance;                  // of the coordinates' origin from the pinhole, along the view (ray_start.h)
    std::vector<std::uint32_t> objects;     // numbers in the caller's scene, of the surfaces that are not in the tree

    // The object that a surface is, by its number in kernels; PT_NO_OBJECT of NO_SURFACE.
    std::uint32_t object_of(std::uint32_t surface) const;
};

// Throws PT_ERROR_UNSUPPORTED if a sphere would have to be held as a plane but moves too far for it.
GpuScene gpu_scene(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings);

// The same of what is left of the scene without twins, seen from where camera rays start.
GpuScene gpu_scene(const DistinctScene &distinct, const PreparedScene &scene, const Camera &start,
                   const RenderSettings &settings);

} // namespace pt
