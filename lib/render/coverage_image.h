// An image of the coverage of samples, into the caller's memory. Used by Renderer.
#pragma once

#include "lib/film/tile_samples.h"
#include "lib/render/image.h"
#include "lib/render/render_device.h"
#include "lib/scene/render_settings.h"

#include <memory>

namespace pt {

// Throws as Coverage and RenderDevice::prepare() do.
void read_coverage(const Image &image, const TileSamples &samples, const RenderSettings &settings,
                   const std::shared_ptr<const GpuScene> &scene, RenderDevice &device);

} // namespace pt
