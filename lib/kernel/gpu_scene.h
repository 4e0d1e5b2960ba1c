// A scene as the kernel reads it: camera-relative float32, laid out as shaders/gpu_layout.h says. Renderer uploads it.
#pragma once

#include "lib/kernel/scene_features.h"
#include "lib/render/render_settings.h"
#include "lib/scene/camera.h"
#include "lib/scene/scene.h"
#include "shaders/gpu_layout.h"

#include <vector>

namespace pt {

// The scene buffer. Positions are taken relative to the camera in double before they are rounded, so that a scene far
// from the origin looks like one at it; motion is restricted to the time in which the shutter is open.
std::vector<glm::vec4> gpu_scene(const Scene &scene, const Camera &camera, const Features &features);

// Power of two that makes one film unit: radiance / unit is what the film sums. It puts the brightest emission into
// [2^7, 2^8) units, so that samples 2^20 times as bright are still accepted and samples 2^-44 times as bright are
// exact, whatever the scene's unit of light is.
double film_unit(const Scene &scene);

// The push constants that do not change from slice to slice.
gpu::FrameConstants frame_constants(const Camera &camera, const RenderSettings &render, double film_unit);

} // namespace pt
