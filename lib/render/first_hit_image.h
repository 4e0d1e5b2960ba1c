// An image of what camera rays meet first, into the caller's memory. Used by Renderer.
#pragma once

#include "lib/kernel/gpu_scene.h"
#include "lib/render/image.h"
#include "lib/render/render_device.h"
#include "lib/scene/render_settings.h"

#include <memory>

namespace pt {

// image: of a quantity that is_of_first_hits. Throws as FirstHits and RenderDevice::prepare() do.
void read_first_hits(const Image &image, const RenderSettings &settings, const std::shared_ptr<const GpuScene> &scene,
                     RenderDevice &device);

} // namespace pt
