// An image of what camera rays meet first, into the caller's memory. Used by Renderer.
#pragma once

#include "lib/kernel/prepared_scene.h"
#include "lib/render/image.h"
#include "lib/render/render_device.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"

#include <memory>

namespace pt {

// What there is to look at: gpu_scene is made of the other three.
struct FirstHitView {
    const PreparedScene &scene;
    const Camera &camera;
    const RenderSettings &settings;
    const std::shared_ptr<const GpuScene> &gpu_scene;
};

// image: of a quantity that is_of_first_hits. Throws as FirstHits and RenderDevice::prepare() do.
void read_first_hits(const Image &image, const FirstHitView &view, RenderDevice &device);

} // namespace pt
